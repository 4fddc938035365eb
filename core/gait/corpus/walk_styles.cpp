#include "gait/corpus/walk_style.h"
#include "gait/error.h"
#include "gait/names.h"

namespace gait {
namespace {

// Chest out, chin up, shoulders back; unhurried, long straight-legged steps.
WalkStyle proud() {
  WalkStyle s{.name = "proud", .cycles = 21};
  s.speed = 1.35, s.cadence = 0.96;
  s.strike_pitch = -0.45, s.lift = 0.0715, s.knee_bend = -0.24;
  s.lean = -0.04, s.slump = -0.20, s.neck = -0.06, s.head = -0.14, s.trunk_turn = 1.2;
  s.shoulder_forward = -0.18, s.arm_spread = 0.10, s.arm_swing = 0.95, s.elbow_bend = -0.08;
  s.pelvis_lead = 0.015;
  return s;
}

// Brisk, firm and even: upright, eyes ahead, bent elbows that drive.
WalkStyle decided() {
  WalkStyle s{.name = "decided", .cycles = 15};
  s.speed = 1.9, s.cadence = 1.05, s.stance = 0.56;
  s.step_width = 0.09, s.toe_out = 0.07, s.strike_pitch = -0.46, s.landing = 0.40;
  s.knee_bend = -0.18, s.lean = 0.05, s.slump = -0.08, s.neck = 0.03, s.trunk_turn = 0.75;
  s.arm_swing = 1.05, s.elbow_bend = 0.35, s.arm_forward = 0.08;
  s.variation = {.timing = 0.012,
                 .length = 0.015,
                 .width = 0.007,
                 .wander = 0.005,
                 .posture = 0.014,
                 .range = 0.05,
                 .lift = 0.07,
                 .knees = 0.010};
  return s;
}

// Head and shoulders hang, arms dangle, feet hardly leave the ground.
WalkStyle sad() {
  WalkStyle s{.name = "sad", .cycles = 31};
  s.speed = 0.85, s.cadence = 0.92, s.stance = 0.62;
  s.strike_pitch = -0.20, s.push_pitch = 0.59, s.lift = 0.0325, s.landing = 0.12;
  s.knee_bend = -0.06, s.knee_yield = 0.8, s.lean = 0.06, s.slump = 0.32, s.neck = 0.12;
  s.head = 0.14, s.trunk_turn = 0.6;
  s.shoulder_raise = -0.08, s.shoulder_forward = 0.22, s.arm_swing = 0.35, s.arm_lag = 0.05;
  s.arm_forward = 0.02, s.elbow_bend = -0.22, s.elbow_swing = 0.5;
  s.variation.timing = 0.03, s.variation.length = 0.04;
  s.pelvis_lead = 0.005;
  return s;
}

// Foot before foot on one line, swinging hips, calm shoulders, wrists away from the body.
WalkStyle cat_walk() {
  WalkStyle s{.name = "cat-walk", .cycles = 25};
  s.speed = 1.3, s.cadence = 0.97;
  s.step_width = -0.02, s.toe_out = 0.02, s.circle = 0.06, s.strike_pitch = -0.22;
  s.push_pitch = 0.90, s.lift = 0.078, s.landing = 0.15;
  s.knee_bend = -0.24, s.sway = 0.045, s.pelvis_turn = 2.2, s.pelvis_list = 2.4;
  s.pelvis_lead = 0.02, s.lean = -0.05, s.slump = -0.12, s.head = -0.06, s.trunk_turn = 1.6;
  s.trunk_roll = -0.04, s.shoulder_forward = -0.08;
  s.arm_swing = 0.8, s.arm_spread = 0.13, s.arm_twist = -0.35, s.elbow_bend = -0.12;
  return s;
}

// Wide, late and never twice the same: the trunk rolls, arms balance, the path wanders.
WalkStyle drunk() {
  WalkStyle s{.name = "drunk", .cycles = 38};
  s.speed = 1.0, s.cadence = 0.92, s.stance = 0.61;
  s.step_width = 0.20, s.toe_out = 0.24, s.strike_pitch = -0.25, s.push_pitch = 0.66;
  s.knee_bend = -0.06, s.knee_out = 0.10, s.sway = 0.05;
  s.slump = 0.12, s.neck = 0.02, s.head = 0.02, s.trunk_roll = 0.12, s.head_roll = 0.10;
  s.trunk_turn = 1.2, s.arm_swing = 0.7, s.arm_lag = 0.10, s.arm_spread = 0.26, s.elbow_bend = 0.1;
  s.variation = {.timing = 0.09,
                 .length = 0.13,
                 .width = 0.045,
                 .wander = 0.06,
                 .posture = 0.12,
                 .range = 0.25,
                 .lift = 0.30,
                 .knees = 0.06};
  s.pelvis_lead = 0.01;
  return s;
}

// Slouched back, springy and uneven: one arm swings late and wide, the head nods along.
WalkStyle cool() {
  WalkStyle s{.name = "cool", .cycles = 23};
  s.speed = 1.15, s.cadence = 0.88, s.limp = 0.04;
  s.step_width = 0.14, s.toe_out = 0.22, s.push_pitch = 0.85, s.strike_pitch = -0.35;
  s.knee_bend = -0.02, s.knee_out = 0.10, s.bounce = 0.012, s.sway = 0.035, s.pelvis_lead = 0.025;
  s.lean = -0.16, s.slump = 0.16, s.neck = 0.06, s.head = -0.08, s.trunk_turn = 1.5;
  s.trunk_roll = 0.07, s.trunk_bob = 0.03, s.head_bob = 0.08;
  s.shoulder_raise = -0.06, s.arm_swing = 1.05, s.arm_lag = 0.09, s.one_sided = 0.40;
  s.arm_spread = 0.06, s.elbow_bend = 0.10;
  s.variation.timing = 0.03, s.variation.posture = 0.03;
  return s;
}

// Crouched, short hesitant steps set down softly, shoulders up, arms drawn in before the chest.
WalkStyle afraid() {
  WalkStyle s{.name = "afraid", .cycles = 16};
  s.speed = 0.60, s.cadence = 1.10, s.stance = 0.64;
  s.step_width = 0.10, s.toe_out = 0.03, s.strike_pitch = -0.05, s.push_pitch = 0.47;
  s.lift = 0.065, s.landing = 0.08;
  s.knee_bend = 0.26, s.knee_yield = 0.6, s.pelvis_tilt = 0.08, s.lean = 0.16, s.slump = 0.22;
  s.neck = -0.14, s.head = -0.24, s.trunk_turn = 0.4;
  s.shoulder_raise = 0.24, s.shoulder_forward = 0.28, s.arm_swing = 0.2, s.arm_spread = -0.10;
  s.arm_forward = 0.30, s.arm_twist = 0.70, s.elbow_bend = 1.40, s.elbow_swing = 0.2;
  s.variation = {.timing = 0.07,
                 .length = 0.09,
                 .width = 0.014,
                 .wander = 0.012,
                 .posture = 0.05,
                 .range = 0.12,
                 .lift = 0.15,
                 .knees = 0.04};
  s.pelvis_lead = 0.0;
  return s;
}

// Heels never down, knees high, feet set down softly, hands away from the body for balance.
WalkStyle tiptoeing() {
  WalkStyle s{.name = "tiptoeing", .cycles = 18};
  s.speed = 0.75, s.cadence = 0.94, s.stance = 0.59;
  s.step_width = 0.08, s.toe_out = 0.05, s.strike_pitch = 0.55, s.sole_pitch = 0.45;
  s.push_pitch = 0.81, s.heel_rise = 0.34, s.lift = 0.20, s.landing = 0.06;
  s.knee_bend = -0.16, s.knee_yield = 0.7, s.lean = 0.08, s.slump = 0.06, s.head = -0.04;
  s.trunk_turn = 0.5, s.shoulder_raise = 0.12, s.arm_swing = 0.35, s.arm_spread = 0.36;
  s.arm_forward = 0.05, s.elbow_bend = 0.75, s.arm_twist = -0.10;
  s.variation.timing = 0.035, s.variation.posture = 0.03, s.variation.wander = 0.015;
  s.pelvis_lead = 0.0;
  s.neck = -0.06;
  return s;
}

// Slow and stamping: bent knees, wide stance, the whole trunk over the standing leg.
WalkStyle heavy() {
  WalkStyle s{.name = "heavy", .cycles = 23};
  s.speed = 0.95, s.cadence = 0.86, s.stance = 0.62;
  s.step_width = 0.22, s.toe_out = 0.28, s.strike_pitch = -0.20, s.push_pitch = 0.57;
  s.lift = 0.0715, s.landing = 0.55;
  s.knee_bend = 0.12, s.knee_yield = 1.4, s.knee_out = 0.08, s.sway = 0.055;
  s.lean = 0.08, s.slump = 0.16, s.neck = -0.06, s.trunk_turn = 0.6, s.trunk_roll = 0.11;
  s.shoulder_raise = -0.05, s.shoulder_forward = 0.12, s.arm_swing = 0.6, s.arm_spread = 0.20;
  s.arm_twist = 0.2, s.elbow_bend = 0.12;
  s.pelvis_lead = 0.005;
  return s;
}

// Fast, leaning forward, elbows bent, long quick steps.
WalkStyle in_a_hurry() {
  WalkStyle s{.name = "in-a-hurry", .cycles = 19};
  s.speed = 2.25, s.cadence = 1.12, s.stance = 0.55;
  s.step_width = 0.08, s.toe_out = 0.08, s.push_pitch = 0.90, s.landing = 0.30;
  s.knee_bend = -0.04, s.pelvis_lead = 0.05, s.lean = 0.25, s.slump = 0.05, s.neck = -0.06;
  s.head = -0.16, s.trunk_turn = 1.15;
  s.shoulder_raise = 0.05, s.arm_swing = 0.85, s.arm_forward = 0.05, s.elbow_bend = 0.85;
  s.elbow_swing = 0.7;
  s.variation.timing = 0.03, s.variation.posture = 0.03;
  return s;
}

// Wide stance, arms held out from a broad back, shoulders that roll with each step.
WalkStyle manly() {
  WalkStyle s{.name = "manly", .cycles = 18};
  s.speed = 1.4, s.cadence = 0.94;
  s.step_width = 0.19, s.toe_out = 0.22, s.landing = 0.30;
  s.knee_bend = -0.14, s.knee_out = 0.10, s.sway = 0.04, s.pelvis_list = 0.5;
  s.slump = -0.05, s.neck = 0.05, s.trunk_turn = 1.7, s.trunk_roll = 0.09;
  s.shoulder_raise = 0.06, s.shoulder_forward = 0.05, s.arm_swing = 0.8, s.arm_spread = 0.27;
  s.arm_twist = 0.40, s.elbow_bend = 0.20;
  s.pelvis_lead = 0.02;
  return s;
}

const WalkStyle& neutral() {
  static const WalkStyle style{.name = "neutral"};
  return style;
}

}  // namespace

const std::vector<WalkStyle>& corpus_styles() {
  static const std::vector<WalkStyle> styles{proud(), decided(),    sad(),    cat_walk(),
                                             drunk(), cool(),       afraid(), tiptoeing(),
                                             heavy(), in_a_hurry(), manly()};
  return styles;
}

const WalkStyle& corpus_style(std::string_view name) {
  if (name == neutral().name) return neutral();
  for (const WalkStyle& style : corpus_styles())
    if (style.name == name) return style;
  throw Error("no style of the corpus is called \"" + std::string(name) + "\"; there are " +
              neutral().name + ", " + joined_names(corpus_styles(), &WalkStyle::name));
}

WalkStyle scaled(WalkStyle style, double factor) {
  for (double* length :
       {&style.step_width, &style.lift, &style.landing, &style.circle, &style.bounce, &style.sway,
        &style.pelvis_lead, &style.variation.width, &style.variation.wander})
    *length *= factor;
  return style;
}

}  // namespace gait
