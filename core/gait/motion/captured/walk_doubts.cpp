#include "gait/motion/captured/walk_doubts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "gait/motion/heading.h"

namespace gait {

namespace {

constexpr int fewest_frames = 8;
// Captured walks in brackets.
constexpr double most_lean = 40;        // degrees of hips to neck from upright (1 to 24)
constexpr double least_hips = 0.75;     // leg lengths above the lower foot (0.86 to 1.1)
constexpr double least_lift = 0.35;     // correlation of lift and swing (0.65 to 0.93)
constexpr double most_sideways = 0.12;  // deviation of the feet's distance across, in legs (0.06)
constexpr double most_uneven = 0.35;    // deviation of step times over their mean (0.17)
constexpr double most_airborne = 0.1;   // share of frames (0.01)
constexpr double off_ground = 0.12;     // leg lengths of the lower foot above its low
constexpr double slowest_step = 1.5, fastest_step = 0.25;  // seconds (0.39 to 0.83)
// Frequency over the natural one (0.85 to 1.39); without, and with, a step time that is odd as
// well.
constexpr double slow_tempo = 0.5, fast_tempo = 2.2;
constexpr double slow_tempo_and_step = 0.7, slow_step = 0.95;
constexpr double fast_tempo_and_step = 1.5, fast_step = 0.3;
constexpr double usual_tempo = 0.97;  // the median of captured walks
// The root's speed over the feet's.
constexpr double least_travel = 0.6, most_travel = 1.7;

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

double covariance(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = mean_of(a), mean_b = mean_of(b);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b);
  return a.empty() ? 0 : sum / static_cast<double>(a.size());
}

double deviation_of(const std::vector<double>& values) {
  return std::sqrt(covariance(values, values));
}

template <typename... Values>
std::string told(const char* format, Values... values) {
  std::array<char, 256> text;
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

// Feet and trunk over the clip, in leg lengths.
struct Posture {
  std::vector<double> low, hips;        // the lower foot's height; the hips' above it
  std::vector<double> ahead, sideways;  // the right foot from the left
  std::vector<double> lift, swing;      // how much higher the right foot is, and its advance
  std::vector<double> lean;             // degrees
  std::vector<double> slip;             // m/s backwards of the lower foot in the world
};

Posture posture_of(const Clip& clip, const JointRoles& roles, const WalkTrack& track) {
  const auto at = [&](int frame, int joint) -> const Eigen::Vector3d& {
    return track.world
        .positions[static_cast<std::size_t>(frame) * clip.skeleton.joints.size() + joint];
  };
  int top = roles.joint(Role::neck);
  if (top < 0) top = roles.joint(Role::head);
  Posture posture;
  for (int frame = 0; frame < clip.frames(); ++frame) {
    const Eigen::Vector3d &right = at(frame, roles.right.foot), &left = at(frame, roles.left.foot);
    const Eigen::Vector3d& hips = at(frame, roles.hips);
    const Eigen::Vector3d forward = heading_direction(track.heading[frame]);
    const Eigen::Vector3d across(forward.z(), 0, -forward.x());
    posture.low.push_back(std::min(right.y(), left.y()) / track.leg_length);
    posture.hips.push_back(hips.y() / track.leg_length - posture.low.back());
    posture.ahead.push_back((right - left).dot(forward) / track.leg_length);
    posture.sideways.push_back((right - left).dot(across) / track.leg_length);
    if (top >= 0) {
      const Eigen::Vector3d trunk = at(frame, top) - hips;
      posture.lean.push_back(std::acos(std::clamp(trunk.normalized().y(), -1.0, 1.0)) * 180 /
                             std::numbers::pi);
    }
  }
  // Over a thirtieth of a second at least, so that a sensor's noise does not look like speed.
  const int span = std::max(1, static_cast<int>(std::lround(clip.frame_rate / 60)));
  for (int frame = span; frame + span < clip.frames(); ++frame) {
    const Eigen::Vector3d &right = at(frame, roles.right.foot), &left = at(frame, roles.left.foot);
    posture.lift.push_back(right.y() - left.y());
    posture.swing.push_back(posture.ahead[frame + span] - posture.ahead[frame - span]);
    const int lower = right.y() < left.y() ? roles.right.foot : roles.left.foot;
    posture.slip.push_back((at(frame - span, lower) - at(frame + span, lower))
                               .dot(heading_direction(track.heading[frame])) *
                           clip.frame_rate / (2 * span));
  }
  return posture;
}

// Share of frames with both feet above the ground, which may rise and fall: the lowest that a foot
// comes to within a second.
double airborne_share(const std::vector<double>& low, double frame_rate) {
  const auto reach = static_cast<std::ptrdiff_t>(frame_rate);
  const auto frames = static_cast<std::ptrdiff_t>(low.size());
  int airborne = 0;
  for (std::ptrdiff_t frame = 0; frame < frames; ++frame) {
    const auto from = low.begin() + std::max<std::ptrdiff_t>(0, frame - reach);
    const auto to = low.begin() + std::min(frames, frame + reach + 1);
    airborne += low[static_cast<std::size_t>(frame)] > *std::min_element(from, to) + off_ground;
  }
  return static_cast<double>(airborne) / static_cast<double>(frames);
}

std::vector<double> step_seconds(const WalkTrack& track, double frame_rate) {
  std::vector<double> seconds;
  for (const Step& step : steps_between(track.contacts))
    seconds.push_back((step.end - step.begin) / frame_rate);
  return seconds;
}

void add_reason(std::string& reasons, const std::string& reason) {
  reasons += (reasons.empty() ? "" : "; ") + reason;
}

std::string why_not_walking(const Clip& clip, const Posture& posture, const WalkTrack& track,
                            const std::vector<double>& steps) {
  std::string reasons;
  const double lean = quantile(posture.lean, 0.5), hips = quantile(posture.hips, 0.5);
  if (lean > most_lean)
    add_reason(reasons, told("the trunk leans %.0f degrees from upright", lean));
  if (hips < least_hips)
    add_reason(reasons, told("the hips are %.2f leg lengths above the lower foot, as of somebody "
                             "who sits or crouches",
                             hips));
  const double ahead = deviation_of(posture.ahead), sideways = deviation_of(posture.sideways);
  if (sideways > most_sideways && sideways > ahead / 2)
    add_reason(reasons, "the feet move apart sideways, not one before the other");
  const double airborne = airborne_share(posture.low, clip.frame_rate);
  if (airborne > most_airborne)
    add_reason(reasons,
               told("both feet are off the ground in %.0f %% of the frames", 100 * airborne));
  if (steps.empty()) {
    if (clip.frames() > 2.5 * clip.frame_rate)
      add_reason(reasons, "the feet do not pass each other");
    return reasons;
  }
  const double lift = covariance(posture.lift, posture.swing) /
                      (deviation_of(posture.lift) * deviation_of(posture.swing) + 1e-12);
  if (std::abs(lift) < least_lift)
    add_reason(reasons, "the foot that swings is not the one that is lifted");
  if (steps.size() >= 4 && deviation_of(steps) > most_uneven * mean_of(steps))
    add_reason(reasons, told("steps last from %.2f to %.2f s, without a rhythm",
                             *std::min_element(steps.begin(), steps.end()),
                             *std::max_element(steps.begin(), steps.end())));
  if (track.treadmill && quantile(posture.slip, 0.5) < 0.4 * track.feet_speed)
    add_reason(reasons, "it steps on the spot, on feet that stay where they are");
  return reasons;
}

double usual_rate_near(double rate) {
  for (const double usual : {24.0, 25.0, 30.0, 50.0, 60.0, 90.0, 100.0, 120.0, 200.0, 240.0})
    if (std::abs(std::log(rate / usual)) < 0.1) return usual;
  return std::round(rate < 1 ? 1 : rate);
}

// Where steps have an odd tempo. How far they reach says how long they should last: at another rate
// frequency and speed change together, and f / sqrt(V) with the root of it.
std::optional<std::string> doubt_of_rate(const Clip& clip, const WalkTrack& track,
                                         const std::vector<double>& steps) {
  if (steps.size() < 2) return std::nullopt;
  const double step = quantile(steps, 0.5), speed_per_leg = track.speed / track.leg_length;
  const double tempo =
      speed_per_leg > 0
          ? 1 / (track.cycle_seconds * natural_frequency(speed_per_leg, track.leg_length))
          : 1;
  const bool slow = step > slowest_step || tempo < slow_tempo ||
                    (tempo < slow_tempo_and_step && step > slow_step);
  const bool fast = step < fastest_step || tempo > fast_tempo ||
                    (tempo > fast_tempo_and_step && step < fast_step);
  if (!slow && !fast) return std::nullopt;
  double faster = std::pow(usual_tempo / tempo, 2);
  // Where the strides do not agree that it is slow (or fast), by the usual step's time.
  if ((slow && faster < 1.2) || (fast && faster > 0.8)) faster = step / 0.55;
  const double rate = usual_rate_near(clip.frame_rate * faster);
  return told(
      "steps of %.2g s at %.4g frames per second are %s than people walk; at %.4g they would "
      "last %.2g s (say --fps %.4g)",
      step, clip.frame_rate, slow ? "slower" : "faster", rate, step * clip.frame_rate / rate, rate);
}

}  // namespace

std::vector<Doubt> walk_doubts(const Clip& clip, const JointRoles& roles, const WalkTrack& track) {
  std::vector<Doubt> doubts;
  if (clip.frames() < fewest_frames || !(track.leg_length > 0)) return doubts;
  const Posture posture = posture_of(clip, roles, track);
  std::vector<double> steps = step_seconds(track, clip.frame_rate);
  const std::string reasons = why_not_walking(clip, posture, track, steps);
  if (!reasons.empty())
    doubts.push_back({DoubtKind::not_walking, "does not look like walking: " + reasons});
  const double travel = std::abs(track.root_speed) / std::max(track.feet_speed, 1e-9);
  if (reasons.empty() && !track.treadmill && steps.size() >= 2 &&
      (travel < least_travel || travel > most_travel))
    doubts.push_back(
        {DoubtKind::travel,
         told(
             "the body travels %.2f m/s where its feet carry it %.2f m/s: they slide, or its place "
             "is in another unit than its bones",
             std::abs(track.root_speed), track.feet_speed)});
  if (auto text = reasons.empty() ? doubt_of_rate(clip, track, steps) : std::nullopt)
    doubts.push_back({DoubtKind::frame_rate, std::move(*text)});
  return doubts;
}

std::vector<std::string> doubts_told(const std::vector<Doubt>& doubts, const std::string& clip) {
  std::vector<std::string> told;
  for (const Doubt& doubt : doubts) told.push_back(clip + ": " + doubt.text);
  return told;
}

}  // namespace gait
