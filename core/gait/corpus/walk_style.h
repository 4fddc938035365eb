// What makes a style of walking: changes of posture, range, timing, speed and arm swing against the
// mean human gait, and how much each step differs from the one before.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gait {

// Standard deviations from step to step; each take of an actor also starts a little differently.
struct StyleVariation {
  double timing = 0.02;    // step duration, share
  double length = 0.025;   // step length, share
  double width = 0.010;    // step width, m
  double wander = 0.008;   // the path's sideways place, m
  double posture = 0.020;  // trunk, head and arms, rad
  double range = 0.07;     // arm swing and trunk turning, share
  double lift = 0.10;      // height of the swinging foot, share
  double knees = 0.015;    // knee bend in stance, rad
};

// Lengths in metres for a leg of `corpus_leg_length`, angles in radians, phases in cycles. Defaults
// are the mean gait. Pitch is positive forward and down.
struct WalkStyle {
  std::string name;
  int cycles = 20;  // how many the corpus holds (T10, Table 1)

  // Speed and rhythm
  double speed = 1.5;     // leg lengths per second
  double cadence = 1.03;  // times the mean gait's frequency at this speed
  double stance = 0.562;  // share of the cycle the ball of a foot is on the ground
  double limp = 0;        // share by which right steps are longer in time, left ones shorter

  // Feet
  double step_width = 0.11;     // between the lines of left and right heels; below 0 they cross
  double toe_out = 0.12;        // yaw of the foot, outwards
  double strike_pitch = -0.40;  // of the foot at contact; below 0 the heel comes first
  double sole_pitch = 0;        // while it bears the body; above 0 the heel stays up
  double push_pitch = 0.75;     // at toe-off
  double heel_rise = 0.29;      // phase of the foot's cycle at which the heel leaves the ground
  double lift = 0.06;           // of the sole, a third into the swing
  double landing = 0.20;        // downward speed at contact, m/s
  double circle = 0;            // sideways arc of the swinging foot, outwards

  // Knees and pelvis
  double knee_bend = -0.14;   // added to the mean gait's knee in stance
  double knee_yield = 1;      // times its movement in stance
  double knee_out = 0;        // yaw of the knees beyond the feet's
  double bounce = 0;          // more rise and fall of the pelvis, once a step
  double sway = 0.022;        // of the pelvis towards the standing leg
  double pelvis_lead = 0.03;  // of the hips before the middle between the ankles, at contact
  double pelvis_turn = 1;     // times the mean gait's yaw
  double pelvis_list = 1;     // times the mean gait's roll: the hip swing
  double pelvis_tilt = 0;     // pitch

  // Trunk and head
  double lean = 0;            // pitch of the whole trunk
  double slump = 0;           // forward bend spread over the back; below 0 the chest is out
  double neck = 0, head = 0;  // pitch
  double trunk_turn = 1;      // times the mean gait's yaw against the pelvis
  double trunk_roll = 0;      // leaning over the standing leg, once a cycle
  double trunk_bob = 0;       // pitching, once a step
  double head_roll = 0;       // tilting, once a cycle
  double head_bob = 0;        // nodding, once a step

  // Arms
  double shoulder_raise = 0, shoulder_forward = 0;
  double arm_swing = 1;    // times the mean gait's
  double arm_lag = 0;      // behind the legs
  double arm_spread = 0;   // away from the trunk
  double arm_forward = 0;  // raised forward
  double arm_twist = 0;    // upper arm about itself, above 0 turns the forearm in
  double elbow_bend = 0;   // added
  double elbow_swing = 1;  // times the mean gait's
  double one_sided = 0;    // right arm: more of the swing; left arm: less of it, more bend

  StyleVariation variation{};
};

inline constexpr double corpus_leg_length = 0.83;  // hip to ankle, metres

// The style of a walker whose leg is `factor` times as long: all lengths times `factor`.
WalkStyle scaled(WalkStyle style, double factor);

// T10's eleven styles in its order.
const std::vector<WalkStyle>& corpus_styles();

// One of them by name ("in-a-hurry"), or "neutral": the mean gait itself. Throws Error for others.
const WalkStyle& corpus_style(std::string_view name);

}  // namespace gait
