#include "gait/corpus/foot_path.h"

#include <algorithm>
#include <cmath>

namespace gait {
namespace {

constexpr double flat_from = 0.11;  // phase

// Pitch per cycle as the foot touches: it falls on its sole.
double touch_slope(const WalkStyle& s) { return 0.7 * (s.sole_pitch - s.strike_pitch) / flat_from; }

// Shares and slopes as the mean gait's foot has them: flat 0.11 of a cycle after contact, pitched
// most 0.17 of the swing after toe-off, falling fastest at 0.6 of the swing.
ShapedCurve pitch_over_the_cycle(const WalkStyle& s) {
  const double swing = 1 - s.stance;
  const double rise = s.push_pitch - s.sole_pitch, push = s.stance - s.heel_rise;
  const double peak = s.push_pitch + 0.25 * rise;
  const double fall = peak - s.strike_pitch;
  return ShapedCurve({{0, s.strike_pitch, touch_slope(s)},
                      {flat_from, s.sole_pitch, 0},
                      {s.heel_rise, s.sole_pitch, 0},
                      {s.stance, s.push_pitch, 2.1 * rise / push},
                      {s.stance + 0.17 * swing, peak, 0},
                      {s.stance + 0.60 * swing, s.strike_pitch + 0.45 * fall, -1.85 * fall / swing},
                      {1, s.strike_pitch, touch_slope(s)}});
}

}  // namespace

FootPath::FootPath(const WalkStyle& style, const Sole& sole, double outward,
                   std::vector<Footprint> prints)
    : style_(style),
      sole_(sole),
      outward_(outward),
      prints_(std::move(prints)),
      pitch_(pitch_over_the_cycle(style)) {}

Eigen::Vector3d FootPath::ankle_over(const Footprint& print, double pitch, bool on_ball) const {
  const double pivot = on_ball ? sole_.ball : -sole_.heel;
  const double up = sole_.ankle_height * std::cos(pitch) + pivot * std::sin(pitch);
  const double forward =
      sole_.heel + pivot - pivot * std::cos(pitch) + sole_.ankle_height * std::sin(pitch);
  return {print.x + forward * std::sin(print.yaw), up, print.z + forward * std::cos(print.yaw)};
}

// Height of the sole's lowest point over the swing: highest after a third of it, as the mean
// gait's, and at the end falling at the style's landing speed, so that contact is a clear event.
double FootPath::clearance(double swing, double lift, double swing_seconds) const {
  const double left = 1 - swing;
  const double rising = swing * swing * left * left * left * left * (729.0 / 16);
  const double fall = style_.landing * swing_seconds;
  return lift * rising + fall * swing * swing * swing * swing * left;
}

FootState FootPath::at(double cycles, double range) const {
  const int last = static_cast<int>(prints_.size()) - 2;
  const int index = std::clamp(static_cast<int>(std::floor(cycles)), 0, last);
  const double phase = std::clamp(cycles - index, 0.0, 1.0);
  const Footprint& from = prints_[static_cast<std::size_t>(index)];
  const Footprint& to = prints_[static_cast<std::size_t>(index) + 1];
  const double pitch = style_.sole_pitch + range * (pitch_.at(phase) - style_.sole_pitch);
  if (phase < style_.stance) return {ankle_over(from, pitch, pitch >= 0), pitch, from.yaw};

  const double swing_share = 1 - style_.stance;
  const double swing = (phase - style_.stance) / swing_share;
  // The ankle is still under way as the foot lands, rolling included, at nine tenths of the body's
  // speed: so it is farthest ahead of the hips some 10 ms before it touches, as a person's is.
  const bool ball_first = style_.strike_pitch >= 0;
  const double pivot = ball_first ? sole_.ball : -sole_.heel;
  const double rolling = touch_slope(style_) * (sole_.ankle_height * std::cos(style_.strike_pitch) +
                                                pivot * std::sin(style_.strike_pitch));
  const double landing_slope = swing_share * (0.9 - rolling / (to.z - from.z));
  const double travelled = swing * swing * (3 - 2 * swing - landing_slope * (1 - swing));
  // Both ends of the path are what stance gives there, so that all of it joins smoothly.
  const Eigen::Vector3d leaving = ankle_over(from, pitch, true);
  const Eigen::Vector3d landing = ankle_over(to, pitch, ball_first);
  Eigen::Vector3d ankle = leaving + travelled * (landing - leaving);
  // The lower of heel and ball bears the clearance; in mid-swing one takes over from the other
  // smoothly, always at or above the larger of the two.
  const double bump = std::pow(4 * swing * (1 - swing), 3);
  const double over_ball = sole_.ball * std::sin(pitch), over_heel = -sole_.heel * std::sin(pitch);
  const double rounding = 0.03 * bump;
  const double support =
      sole_.ankle_height * std::cos(pitch) +
      0.5 * (over_ball + over_heel + std::hypot(over_ball - over_heel, rounding));
  ankle.y() =
      support + clearance(swing, style_.lift * from.lift, swing_share * (to.time - from.time));
  ankle.x() += outward_ * style_.circle * bump;
  return {ankle, pitch, from.yaw + travelled * (to.yaw - from.yaw)};
}

}  // namespace gait
