#include "evaluation_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "json_report.h"
#include "number_words.h"

namespace gait::tool {

namespace {

using nlohmann::ordered_json;

constexpr double degrees = 180 / std::numbers::pi;

// Styles of the clips, in the order they come; those the model does not know among them.
std::vector<std::string> styles_of(const Evaluation& evaluation) {
  std::vector<std::string> styles;
  for (const EvaluatedClip& clip : evaluation.clips)
    if (!clip.style.empty() && std::find(styles.begin(), styles.end(), clip.style) == styles.end())
      styles.push_back(clip.style);
  std::sort(styles.begin(), styles.end());
  return styles;
}

int clips_of(const Evaluation& evaluation, const std::string& style) {
  return static_cast<int>(
      std::count_if(evaluation.clips.begin(), evaluation.clips.end(),
                    [&](const EvaluatedClip& clip) { return clip.style == style; }));
}

double delay_ms(const Evaluation& evaluation, const Model& model) {
  return 1000 * evaluation.delay_frames / model.frame_rate;
}

void print_row(const std::string& what, const char* format, const Means& means,
               const std::string& meaning) {
  const auto number = [&](double value) {
    return std::isnan(value) ? std::string("-") : in_words(format, value);
  };
  std::printf("  %-22s %9s %9s  %s\n", what.c_str(), number(means.over_clips).c_str(),
              number(means.pooled).c_str(), meaning.c_str());
}

Means in_degrees(const Means& radians) {
  return {radians.over_clips * degrees, radians.pooled * degrees};
}

void print_recognition(const Evaluation& evaluation) {
  print_row("step accuracy", "%.3f", evaluation.step_accuracy(),
            "share of frames with the right step, left or right");
  if (std::isnan(evaluation.style_accuracy().over_clips)) return;
  print_row("style accuracy", "%.3f", evaluation.style_accuracy(),
            "share of frames with the right style");
  print_row("  of whole clips", "%.3f", {evaluation.style_accuracy_of_clips(), NAN},
            "share of clips with the right style");
  print_row("  calibration error", "%.3f", {NAN, evaluation.calibration_error},
            "gap between how sure of the style and how often right; 0 is best");
}

void print_outputs(const Evaluation& evaluation) {
  const char* meanings[] = {"degrees off the true joints, if one average pose stood in throughout",
                            "with the average pose of the recognised moment",
                            "with this walk's own way mapped onto it",
                            "in what comes out: the same, smoothed"};
  for (const Estimate estimate : estimates)
    print_row("error, " + std::string(estimate_name(estimate)), "%.2f",
              in_degrees(evaluation.error(estimate)), meanings[static_cast<int>(estimate)]);
  for (const bool known : {true, false}) {
    const Means error = evaluation.error_of_people(Estimate::synthesised, known);
    if (!std::isnan(error.over_clips))
      print_row(known ? "  known people" : "  strangers", "%.2f", in_degrees(error),
                known ? "of it, clips of people whom the model was learnt from"
                      : "of it, clips of people whom the model has not seen");
  }
  print_row("jerk, truth", "%.0f", evaluation.jerk(Source::truth),
            "how abruptly joints move in the clips, rad/s^3");
  print_row("jerk, mapped", "%.0f", evaluation.jerk(Source::mapped), "");
  print_row("jerk, synthesised", "%.0f", evaluation.jerk(Source::synthesised), "");
  print_row("foot slide, captured", "%.0f", evaluation.foot_slide(Source::truth),
            "mm the standing foot travels per stance in the clips");
  print_row("foot slide, found", "%.0f", evaluation.foot_slide(Source::synthesised),
            "the same in what comes out");
  print_row("path", "%.3f", evaluation.path_ratio(),
            "way the found feet carry the hips, over the captured way; 1 is best");
}

// Contacts against the feet's own, in ms.
void print_contacts(const Evaluation& evaluation) {
  if (evaluation.contacts(Heard::step).touched == 0) return;
  std::printf(
      "\nContacts, ms late (of the feet's touch, between frames)\n  %-22s %7s %7s %7s %7s %9s %7s "
      "%7s\n",
      "", "mean", "SD", "5 %", "95 %", "contacts", "missed", "extra");
  for (const Heard heard : ways_heard) {
    const ContactErrors errors = evaluation.contacts(heard);
    std::printf("  %-22s %7.1f %7.1f %7.1f %7.1f %9d %7d %7d\n",
                std::string(heard_name(heard)).c_str(), 1000 * errors.mean(),
                1000 * errors.deviation(), 1000 * errors.quantile(0.05),
                1000 * errors.quantile(0.95), errors.touched, errors.missed, errors.extra);
  }
}

void print_styles(const Evaluation& evaluation) {
  const auto styles = styles_of(evaluation);
  if (styles.empty()) return;
  std::printf("\nBy style: error in degrees, means over clips\n  %-16s %5s", "", "clips");
  for (const Estimate estimate : estimates)
    std::printf(" %12s", std::string(estimate_name(estimate)).c_str());
  std::printf("\n");
  for (const std::string& style : styles) {
    std::printf("  %-16s %5d", style.c_str(), clips_of(evaluation, style));
    for (const Estimate estimate : estimates)
      std::printf(" %12.2f", evaluation.error(estimate, style).over_clips * degrees);
    std::printf("\n");
  }
}

void print_joints(const Evaluation& evaluation) {
  std::printf("\nBy joint: error in degrees, means over clips\n  %-22s", "");
  for (const Estimate estimate : estimates)
    std::printf(" %12s", std::string(estimate_name(estimate)).c_str());
  std::printf("\n");
  for (std::size_t i = 0; i < evaluation.output_names.size(); ++i) {
    std::printf("  %-22s", evaluation.output_names[i].c_str());
    for (const Estimate estimate : estimates)
      std::printf(" %12.2f",
                  evaluation.stream_error(estimate, static_cast<int>(i)).over_clips * degrees);
    std::printf("%s\n", evaluation.counted[i] ? "" : "  (not in the errors above)");
  }
}

void print_confusion(const Evaluation& evaluation) {
  if (evaluation.confusion.sum() == 0) return;
  std::printf("\nStyles: a row's walks were taken for (%% of frames)\n  %-16s", "");
  for (const std::string& style : evaluation.styles) std::printf(" %7.7s", style.c_str());
  std::printf("\n");
  for (Eigen::Index row = 0; row < evaluation.confusion.rows(); ++row) {
    const double all = evaluation.confusion.row(row).sum();
    if (all == 0) continue;
    std::printf("  %-16s", evaluation.styles[row].c_str());
    for (Eigen::Index column = 0; column < evaluation.confusion.cols(); ++column) {
      const int count = evaluation.confusion(row, column);
      count == 0 ? std::printf(" %7s", ".") : std::printf(" %7.1f", 100 * count / all);
    }
    std::printf("\n");
  }
}

// JSON knows no NaN: what could not be measured is null.
ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}
ordered_json both(const Means& means) {
  return {{"clips", number(means.over_clips)}, {"pooled", number(means.pooled)}};
}
std::string key_of(Estimate estimate) {
  std::string key(estimate_name(estimate));
  std::replace(key.begin(), key.end(), ' ', '_');
  return key;
}

// `error`: gives the radians of a estimate.
template <typename Error>
ordered_json errors_json(Error error) {
  ordered_json errors;
  for (const Estimate estimate : estimates)
    errors[key_of(estimate)] = both(in_degrees(error(estimate)));
  return errors;
}

ordered_json clip_json(const EvaluatedClip& clip, const Evaluation& evaluation) {
  Evaluation alone;
  alone.counted = evaluation.counted;
  alone.styles = evaluation.styles;
  alone.clips = {clip};
  ordered_json errors;
  for (const Estimate estimate : estimates)
    errors[key_of(estimate)] = number(alone.error(estimate).over_clips * degrees);
  return {{"clip", clip.name},
          {"style", clip.style},
          {"subject", clip.subject},
          {"subject_in_training",
           clip.subject.empty() ? ordered_json(nullptr) : ordered_json(clip.subject_known)},
          {"recognised_style",
           clip.best_style < 0 ? std::string() : evaluation.styles[clip.best_style]},
          {"frames", clip.frames},
          {"step_accuracy", number(alone.step_accuracy().over_clips)},
          {"style_accuracy", number(alone.style_accuracy().over_clips)},
          {"output_error_deg", errors},
          {"path_ratio", number(alone.path_ratio().over_clips)},
          {"foot_slide_mm",
           {{"captured", number(alone.foot_slide(Source::truth).over_clips)},
            {"synthesised", number(alone.foot_slide(Source::synthesised).over_clips)}}}};
}

ordered_json contacts_json(const Evaluation& evaluation, const std::string& style = {}) {
  ordered_json ways;
  for (const Heard heard : ways_heard) {
    const ContactErrors errors = evaluation.contacts(heard, style);
    ways[std::string(heard_name(heard))] = {{"late_ms",
                                             {{"mean", number(1000 * errors.mean())},
                                              {"deviation", number(1000 * errors.deviation())},
                                              {"p5", number(1000 * errors.quantile(0.05))},
                                              {"p95", number(1000 * errors.quantile(0.95))}}},
                                            {"contacts", errors.touched},
                                            {"missed", errors.missed},
                                            {"extra", errors.extra}};
  }
  return ways;
}

ordered_json confusion_json(const Evaluation& evaluation) {
  ordered_json rows = ordered_json::array();
  for (Eigen::Index row = 0; row < evaluation.confusion.rows(); ++row) {
    ordered_json columns = ordered_json::array();
    for (Eigen::Index column = 0; column < evaluation.confusion.cols(); ++column)
      columns.push_back(evaluation.confusion(row, column));
    rows.push_back(columns);
  }
  return {{"styles", evaluation.styles}, {"frames", rows}};
}

}  // namespace

void print_table(const Evaluation& evaluation, const Model& model) {
  std::printf("%s on %zu clips%s\n", model.name.c_str(), evaluation.clips.size(),
              model.training.synthetic ? " (the model is synthetic)" : "");
  std::printf("  %-22s %9s %9s\n", "", "clips", "pooled");
  print_recognition(evaluation);
  print_outputs(evaluation);
  std::printf("  %-22s %.0f, %.0f, %.0f  microseconds: median, 99 of 100, longest\n",
              "time per frame", evaluation.frame_time(0.5), evaluation.frame_time(0.99),
              evaluation.frame_time(1));
  std::printf("  %-22s %d frames, %.0f ms\n", "delay", evaluation.delay_frames,
              delay_ms(evaluation, model));
  print_contacts(evaluation);
  print_styles(evaluation);
  print_joints(evaluation);
  print_confusion(evaluation);
}

void print_json(const Evaluation& evaluation, const Model& model) {
  ordered_json styles = ordered_json::object(), joints = ordered_json::object();
  for (const std::string& style : styles_of(evaluation))
    styles[style] = {{"clips", clips_of(evaluation, style)},
                     {"output_error_deg", errors_json([&](Estimate estimate) {
                        return evaluation.error(estimate, style);
                      })},
                     {"contacts", contacts_json(evaluation, style)}};
  for (std::size_t i = 0; i < evaluation.output_names.size(); ++i) {
    const ordered_json errors = errors_json(
        [&](Estimate estimate) { return evaluation.stream_error(estimate, static_cast<int>(i)); });
    joints[evaluation.output_names[i]] = {{"counted", bool(evaluation.counted[i])},
                                          {"output_error_deg", errors}};
  }
  ordered_json clips = ordered_json::array();
  for (const EvaluatedClip& clip : evaluation.clips) clips.push_back(clip_json(clip, evaluation));

  const ordered_json report{
      {"model", model.name},
      {"synthetic", model.training.synthetic},
      {"clips", evaluation.clips.size()},
      {"skipped", evaluation.skipped},
      {"step_accuracy", both(evaluation.step_accuracy())},
      {"style_accuracy", both(evaluation.style_accuracy())},
      {"style_accuracy_of_clips", number(evaluation.style_accuracy_of_clips())},
      {"style_calibration_error", std::isnan(evaluation.style_accuracy().pooled)
                                      ? ordered_json(nullptr)
                                      : number(evaluation.calibration_error)},
      {"style_confusion", confusion_json(evaluation)},
      {"output_error_deg",
       errors_json([&](Estimate estimate) { return evaluation.error(estimate); })},
      {"known_people_error_deg",
       both(in_degrees(evaluation.error_of_people(Estimate::synthesised, true)))},
      {"strangers_error_deg",
       both(in_degrees(evaluation.error_of_people(Estimate::synthesised, false)))},
      {"contacts", contacts_json(evaluation)},
      {"jerk",
       {{"truth", both(evaluation.jerk(Source::truth))},
        {"mapped", both(evaluation.jerk(Source::mapped))},
        {"synthesised", both(evaluation.jerk(Source::synthesised))}}},
      {"foot_slide_mm",
       {{"captured", both(evaluation.foot_slide(Source::truth))},
        {"synthesised", both(evaluation.foot_slide(Source::synthesised))}}},
      {"path_ratio", both(evaluation.path_ratio())},
      {"frame_microseconds",
       {{"p50", number(evaluation.frame_time(0.5))},
        {"p99", number(evaluation.frame_time(0.99))},
        {"max", number(evaluation.frame_time(1))}}},
      {"delay", {{"frames", evaluation.delay_frames}, {"ms", delay_ms(evaluation, model)}}},
      {"by_style", styles},
      {"by_joint", joints},
      {"by_clip", clips}};
  print_report(report);
}

}  // namespace gait::tool
