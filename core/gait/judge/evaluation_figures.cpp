// The means of an evaluation.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "gait/judge/evaluation.h"

namespace gait {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// `sum` over `count`, which are members of EvaluatedClip or functions of one.
template <typename Sum, typename Count>
Means averaged(const std::vector<EvaluatedClip>& clips, Sum sum, Count count) {
  double shares = 0, averaged_clips = 0, total = 0, weight = 0;
  for (const EvaluatedClip& clip : clips) {
    const double frames = std::invoke(count, clip);
    if (frames <= 0) continue;
    const double of_clip = std::invoke(sum, clip);
    shares += of_clip / frames;
    averaged_clips += 1;
    total += of_clip;
    weight += frames;
  }
  return weight > 0 ? Means{shares / averaged_clips, total / weight} : Means{none, none};
}

double counted_mean(const Eigen::VectorXd& sums, const std::vector<bool>& counted) {
  double sum = 0;
  int streams = 0;
  for (std::size_t i = 0; i < counted.size(); ++i)
    if (counted[i]) sum += sums[static_cast<Eigen::Index>(i)], ++streams;
  return streams > 0 ? sum / streams : 0;
}

}  // namespace

Means Evaluation::error(Estimate estimate, const std::string& style) const {
  return averaged(
      clips,
      [&](const EvaluatedClip& clip) {
        return counted_mean(clip.angle_sums[static_cast<int>(estimate)], counted);
      },
      [&](const EvaluatedClip& clip) {
        return style.empty() || clip.style == style ? clip.frames : 0;
      });
}

Means Evaluation::error_of_people(Estimate estimate, bool known) const {
  return averaged(
      clips,
      [&](const EvaluatedClip& clip) {
        return counted_mean(clip.angle_sums[static_cast<int>(estimate)], counted);
      },
      [&](const EvaluatedClip& clip) {
        return !clip.subject.empty() && clip.subject_known == known ? clip.frames : 0;
      });
}

Means Evaluation::stream_error(Estimate estimate, int stream) const {
  return averaged(
      clips,
      [&](const EvaluatedClip& clip) {
        return clip.angle_sums[static_cast<int>(estimate)][stream];
      },
      &EvaluatedClip::frames);
}

Means Evaluation::step_accuracy() const {
  return averaged(clips, &EvaluatedClip::right_steps, &EvaluatedClip::frames);
}

Means Evaluation::style_accuracy() const {
  return averaged(clips, &EvaluatedClip::right_styles,
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

Means Evaluation::jerk(Source source) const {
  const auto sum = source == Source::truth    ? &EvaluatedClip::jerk_truth
                   : source == Source::mapped ? &EvaluatedClip::jerk_mapped
                                              : &EvaluatedClip::jerk_synthesised;
  return averaged(clips, sum, &EvaluatedClip::jerk_frames);
}

Means Evaluation::foot_slide(Source source) const {
  const auto sum =
      source == Source::truth ? &EvaluatedClip::slide_captured : &EvaluatedClip::slide_synthesised;
  return averaged(clips, sum, &EvaluatedClip::stances);
}

Means Evaluation::path_ratio() const {
  return averaged(clips, &EvaluatedClip::path_synthesised, &EvaluatedClip::path_captured);
}

ContactErrors Evaluation::contacts(Heard heard, const std::string& style) const {
  ContactErrors all;
  for (const EvaluatedClip& clip : clips)
    if (style.empty() || clip.style == style) all.add(clip.timing[static_cast<std::size_t>(heard)]);
  return all;
}

double Evaluation::frame_time(double quantile) const {
  if (frame_microseconds.empty()) return none;
  const auto last = static_cast<double>(frame_microseconds.size() - 1);
  return frame_microseconds[static_cast<std::size_t>(std::lround(quantile * last))];
}

}  // namespace gait
