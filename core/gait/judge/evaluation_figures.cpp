// The means of an evaluation.
#include <algorithm>
#include <cmath>
#include <limits>

#include "gait/judge/evaluation.h"

namespace gait {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Mean of per-clip shares, or of all frames together.
template <typename Sum, typename Count>
double averaged(const std::vector<EvaluatedClip>& clips, bool pooled, Sum sum, Count count) {
  double total = 0, weight = 0;
  for (const EvaluatedClip& clip : clips) {
    const double frames = count(clip);
    if (frames <= 0) continue;
    total += pooled ? sum(clip) : sum(clip) / frames;
    weight += pooled ? frames : 1;
  }
  return weight > 0 ? total / weight : none;
}

double counted_mean(const Eigen::VectorXd& sums, const std::vector<bool>& counted) {
  double sum = 0;
  int streams = 0;
  for (std::size_t i = 0; i < counted.size(); ++i)
    if (counted[i]) sum += sums[static_cast<Eigen::Index>(i)], ++streams;
  return streams > 0 ? sum / streams : 0;
}

}  // namespace

double Evaluation::error(Estimate estimate, bool pooled, const std::string& style) const {
  return averaged(
      clips, pooled,
      [&](const EvaluatedClip& clip) {
        return counted_mean(clip.angle_sums[static_cast<int>(estimate)], counted);
      },
      [&](const EvaluatedClip& clip) {
        return style.empty() || clip.style == style ? clip.frames : 0;
      });
}

double Evaluation::stream_error(Estimate estimate, int stream, bool pooled) const {
  return averaged(
      clips, pooled,
      [&](const EvaluatedClip& clip) {
        return clip.angle_sums[static_cast<int>(estimate)][stream];
      },
      [](const EvaluatedClip& clip) { return clip.frames; });
}

double Evaluation::step_accuracy(bool pooled) const {
  return averaged(
      clips, pooled, [](const EvaluatedClip& clip) { return clip.right_steps; },
      [](const EvaluatedClip& clip) { return clip.frames; });
}

double Evaluation::style_accuracy(bool pooled) const {
  return averaged(
      clips, pooled, [](const EvaluatedClip& clip) { return clip.right_styles; },
      [](const EvaluatedClip& clip) { return clip.style_known ? clip.frames : 0; });
}

double Evaluation::style_accuracy_of_clips() const {
  double right = 0, known = 0;
  for (const EvaluatedClip& clip : clips) {
    if (!clip.style_known) continue;
    right += clip.best_style >= 0 && styles[clip.best_style] == clip.style;
    known += 1;
  }
  return known > 0 ? right / known : none;
}

double Evaluation::jerk(Source source, bool pooled) const {
  return averaged(
      clips, pooled,
      [&](const EvaluatedClip& clip) {
        return source == Source::truth    ? clip.jerk_truth
               : source == Source::mapped ? clip.jerk_mapped
                                          : clip.jerk_synthesised;
      },
      [](const EvaluatedClip& clip) { return clip.jerk_frames; });
}

double Evaluation::foot_slide(Source source, bool pooled) const {
  return averaged(
      clips, pooled,
      [&](const EvaluatedClip& clip) {
        return source == Source::truth ? clip.slide_captured : clip.slide_synthesised;
      },
      [](const EvaluatedClip& clip) { return clip.stances; });
}

double Evaluation::path_ratio(bool pooled) const {
  return averaged(
      clips, pooled, [](const EvaluatedClip& clip) { return clip.path_synthesised; },
      [](const EvaluatedClip& clip) { return clip.path_captured; });
}

double Evaluation::frame_time(double quantile) const {
  if (frame_microseconds.empty()) return none;
  const auto last = static_cast<double>(frame_microseconds.size() - 1);
  return frame_microseconds[static_cast<std::size_t>(std::lround(quantile * last))];
}

}  // namespace gait
