#include "gait/offline/planned_walk.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "gait/error.h"
#include "gait/names.h"
#include "gait/offline/walk_recorder.h"
#include "gait/play/cycles/style_walker.h"

namespace gait {

namespace {

std::string styles_that_walk(const Model& model) {
  std::string names;
  for (std::size_t i = 0; i < model.styles.size(); ++i)
    if (!model.style_space || model.style_space->styles[i].cycles > 0)
      append_name(names, model.styles[i]);
  return names;
}

std::string in_words(const char* format, double a, double b) {
  char text[160];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

// What the walker will take of what was asked, in words where that is something else.
std::vector<std::string> clamped(const SpeedWalkPlan& plan, double leg_length) {
  std::vector<std::string> remarks;
  if (plan.leg_length > 0 && std::abs(leg_length - plan.leg_length) > 1e-6)
    remarks.push_back(
        in_words("a leg of %.3g m is clamped to %.3g m", plan.leg_length, leg_length));
  const double most = std::min<double>(highest_speed, highest_speed_per_leg * leg_length);
  std::vector<double> asked{plan.from};
  if (plan.to != plan.from) asked.push_back(plan.to);
  for (const double speed : asked) {
    const double taken = std::clamp(speed, 0.0, most);
    // Speeds in km/h are not exact in m/s.
    if (std::abs(taken - speed) < 1e-6) continue;
    std::string remark =
        in_words("a speed of %.4g km/h is clamped to %.4g km/h", speed * 3.6, taken * 3.6);
    if (most < highest_speed && speed > most)
      remark += in_words(", the most for a leg of %.3g m", leg_length, 0);
    remarks.push_back(remark);
  }
  return remarks;
}

double speed_at(const SpeedWalkPlan& plan, double seconds) {
  const double share = std::clamp((seconds / plan.seconds - 0.1) / 0.8, 0.0, 1.0);
  return plan.from + share * (plan.to - plan.from);
}

}  // namespace

std::vector<float> style_weights(const Model& model, std::span<const StyleShare> shares) {
  std::vector<double> weights(model.styles.size());
  double sum = 0;
  for (const StyleShare& share : shares) {
    const auto at = std::find(model.styles.begin(), model.styles.end(), share.style);
    if (at == model.styles.end())
      throw Error("model " + model.name + ": no style is called '" + share.style + "'; it has " +
                  styles_that_walk(model));
    const auto style = static_cast<std::size_t>(at - model.styles.begin());
    if (model.style_space && model.style_space->styles[style].cycles == 0)
      throw Error("model " + model.name + ": style '" + share.style +
                  "' was learnt from no straight cycle and cannot walk; these can: " +
                  styles_that_walk(model));
    if (!(share.weight >= 0) || !std::isfinite(share.weight))
      throw Error("expected weights of styles that are not negative, found " + share.style + "=" +
                  std::to_string(share.weight));
    weights[style] += share.weight;
    sum += share.weight;
  }
  if (!(sum > 0) || !std::isfinite(sum))
    throw Error("expected a style with a weight above 0, found none");
  std::vector<float> normalised;
  for (const double weight : weights) normalised.push_back(static_cast<float>(weight / sum));
  return normalised;
}

Clip styled_walk(const std::shared_ptr<const Model>& model, const StyledWalkPlan& plan) {
  StyleWalker walker(model, plan.seed);
  const double frame_rate = plan.frame_rate > 0 ? plan.frame_rate : model->frame_rate;
  std::vector<std::vector<float>> wanted;
  for (const StyleChange& change : plan.changes)
    wanted.push_back(style_weights(*model, change.mix));
  if (!walker.set_weights(style_weights(*model, plan.mix)) ||
      !walker.set_variation(static_cast<float>(plan.variation)) ||
      !walker.set_exaggeration(static_cast<float>(plan.exaggeration)))
    throw Error("expected a plan of finite numbers for the style walker");

  WalkRecorder recorder(*model->body, frame_rate, 1, plan.turn);
  const auto led = static_cast<std::int64_t>(std::ceil(lead_in_seconds * frame_rate));
  std::int64_t first = 0;  // cycle
  for (std::int64_t frame = 0; first == 0; ++frame) {
    recorder.lead_in(walker.pose());
    const std::int64_t before = walker.cycle();
    walker.advance(1 / frame_rate);
    if (frame + 1 >= led && walker.cycle() > before) first = walker.cycle();
  }
  const auto frames = static_cast<int>(std::lround(std::max(0.0, plan.seconds) * frame_rate)) + 1;
  std::size_t changed = 0;
  bool done = false;
  while (!done) {
    for (; changed < wanted.size() &&
           plan.changes[changed].seconds <= recorder.frames() / frame_rate + 1e-9;
         ++changed)
      walker.set_weights(wanted[changed]);
    recorder.add(walker.pose());
    // With the frame that begins the next cycle the last one is whole.
    done = plan.cycles > 0 ? walker.cycle() >= first + plan.cycles : recorder.frames() >= frames;
    walker.advance(1 / frame_rate);
  }
  return recorder.clip("walk");
}

SpeedWalk speed_walk(const PlayModel& played, const SpeedWalkPlan& plan) {
  const std::shared_ptr<const Model>& model = played.model;
  SpeedWalker walker(played.speeds());
  if (!(plan.seconds > 0) || !std::isfinite(plan.from) || !std::isfinite(plan.to))
    throw Error("expected a plan of finite speeds and some seconds for the speed walker");
  if (!plan.subject.empty() && walker.set_subject(plan.subject) == ControlResult::refused) {
    const auto name_of = [](const auto& subject) { return subject.subject; };
    throw Error("model " + model->name + ": no subject is called '" + plan.subject + "'; it has " +
                joined_names(walker.subjects(), name_of));
  }
  if (plan.leg_length > 0) walker.set_leg_length(static_cast<float>(plan.leg_length));
  walker.set_law(plan.law);
  walker.set_speed(static_cast<float>(plan.from));
  walker.settle();

  SpeedWalk walk;
  walk.leg_length = walker.leg_length();
  walk.remarks = clamped(plan, walk.leg_length);
  const double frame_rate = plan.frame_rate > 0 ? plan.frame_rate : model->frame_rate;
  WalkRecorder recorder(*model->body, frame_rate, walker.scale(), plan.turn);
  const auto led = static_cast<int>(std::ceil(lead_in_seconds * frame_rate));
  for (int frame = 0; frame < led && !walker.standing(); ++frame) {
    recorder.lead_in(walker.pose());
    walker.advance(1 / frame_rate);
  }
  const auto frames = static_cast<int>(std::lround(plan.seconds * frame_rate)) + 1;
  for (int frame = 0; frame < frames; ++frame) {
    recorder.add(walker.pose());
    walk.phase.push_back(walker.phase());
    walk.speed.push_back(walker.speed());
    walker.set_speed(static_cast<float>(speed_at(plan, (frame + 1) / frame_rate)));
    walker.advance(1 / frame_rate);
  }
  walk.clip = recorder.clip("walk");
  return walk;
}

}  // namespace gait
