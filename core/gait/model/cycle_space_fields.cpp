#include "gait/model/cycle_space_fields.h"

#include <nlohmann/json.hpp>

#include "gait/model/array_node.h"

namespace gait {

namespace {

using Json = nlohmann::json;

Json node(const Variation& variation) {
  return {{"mean", variation.mean},
          {"deviation", variation.deviation},
          {"largest_change", variation.largest_change},
          {"lowest", variation.lowest},
          {"highest", variation.highest}};
}

Variation variation_of(const ModelField& field) {
  return {.mean = field["mean"].number(),
          .deviation = field["deviation"].number(),
          .largest_change = field["largest_change"].number(),
          .lowest = field["lowest"].number(),
          .highest = field["highest"].number()};
}

}  // namespace

Json field_of(const CycleSpace& space) {
  return {{"frames", space.frames},
          {"joints", space.joints},
          {"mean", array_node(space.mean)},
          {"components", array_node(space.components)},
          {"variances", array_node(space.variances)}};
}

Json field_of(const StyleSpace& space) {
  Json styles = Json::array();
  for (const StyleCycles& style : space.styles) {
    Json scores = Json::array();
    for (const Variation& score : style.scores) scores.push_back(node(score));
    styles.push_back({{"cycles", style.cycles},
                      {"scores", std::move(scores)},
                      {"duration", node(style.duration)},
                      {"correlation", symmetric_array_node(style.correlation)},
                      {"projected", array_node(style.projected)},
                      {"durations", array_node(style.durations)}});
  }
  return {{"space", field_of(space.space)},
          {"cycles_per_style", space.cycles_per_style},
          {"styles", std::move(styles)}};
}

Json field_of(const SpeedSpace& space) {
  Json field = {{"subject", space.subject},
                {"leg_length", space.leg_length},
                {"space", field_of(space.space)},
                {"cycles", space.cycles},
                {"intercept", array_node(space.intercept)},
                {"slope", array_node(space.slope)},
                {"standing", array_node(space.standing)},
                {"slowest", space.slowest},
                {"fastest", space.fastest},
                {"speeds", array_node(space.speeds)},
                {"frequencies", array_node(space.frequencies)},
                {"projected", array_node(space.projected)},
                {"frequency_scale", space.frequency_scale},
                {"frequency_power", space.frequency_power}};
  if (space.shared.intercept.size() > 0)
    field["shared"] = {{"intercept", array_node(space.shared.intercept)},
                       {"slope", array_node(space.shared.slope)},
                       {"standing", array_node(space.shared.standing)},
                       {"projected", array_node(space.shared.projected)}};
  return field;
}

CycleSpace cycle_space(const ModelField& field) {
  return {.frames = field["frames"].integer(),
          .joints = field["joints"].integers(),
          .mean = field["mean"].vector(),
          .components = field["components"].matrix(),
          .variances = field["variances"].vector()};
}

StyleSpace style_space(const ModelField& field) {
  StyleSpace space;
  space.space = cycle_space(field["space"]);
  space.cycles_per_style = field["cycles_per_style"].integer();
  for (const ModelField& item : field["styles"].items()) {
    StyleCycles style;
    style.cycles = item["cycles"].integer();
    for (const ModelField& score : item["scores"].items())
      style.scores.push_back(variation_of(score));
    style.duration = variation_of(item["duration"]);
    style.correlation = item["correlation"].symmetric();
    style.projected = item["projected"].matrix();
    style.durations = item["durations"].vector();
    space.styles.push_back(std::move(style));
  }
  return space;
}

SpeedSpace speed_space(const ModelField& field) {
  SpeedSpace space;
  space.subject = field["subject"].text();
  space.leg_length = field["leg_length"].number();
  space.space = cycle_space(field["space"]);
  space.cycles = field["cycles"].integer();
  space.intercept = field["intercept"].vector();
  space.slope = field["slope"].vector();
  space.standing = field["standing"].vector();
  space.slowest = field["slowest"].number();
  space.fastest = field["fastest"].number();
  space.speeds = field["speeds"].vector();
  space.frequencies = field["frequencies"].vector();
  space.projected = field["projected"].matrix();
  space.frequency_scale = field["frequency_scale"].number();
  space.frequency_power = field["frequency_power"].number();
  if (const auto shared = field.find("shared"))
    space.shared = {(*shared)["intercept"].vector(), (*shared)["slope"].vector(),
                    (*shared)["standing"].vector(), (*shared)["projected"].matrix()};
  return space;
}

}  // namespace gait
