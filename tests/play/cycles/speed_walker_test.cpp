#include "gait/play/cycles/speed_walker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "gait/error.h"
#include "gait/judge/foot_slide.h"
#include "gait/model/body_pose.h"
#include "gait/motion/rotation.h"
#include "gait/offline/walk_recorder.h"
#include "gait/play/body/root_motion.h"
#include "gait/play/play_model.h"
#include "motion/walked_ways.h"
#include "play/body/sole_height.h"
#include "play/cycles/walks_over_speed.h"
#include "play/forbidden_memory.h"

namespace gait {
namespace {

using Pose = std::vector<Eigen::Quaternionf>;

constexpr double frame = 1.0 / 60;

const std::shared_ptr<const SpeedTables>& tables() {
  static const auto made = make_speed_tables(*testing::speed_model());
  return made;
}

SpeedWalker walker() { return SpeedWalker(tables()); }

Pose pose_of(const SpeedWalker& walking) { return {walking.pose().begin(), walking.pose().end()}; }

void walk(SpeedWalker& walking, double seconds) {
  for (double t = 0; t < seconds; t += frame) walking.advance(frame);
}

float largest_turn(const Pose& a, const Pose& b) {
  float largest = 0;
  for (std::size_t joint = 0; joint < a.size(); ++joint)
    largest = std::max(largest, angle_between(a[joint], b[joint]));
  return largest;
}

// Speed of the root over whole cycles, by the feet alone.
double travelled_speed(SpeedWalker& walking, const Model& model = *testing::speed_model()) {
  const Body& body = *model.body;
  RootMotion root(body.skeleton, body_roles(body), 1 / frame);
  std::vector<Eigen::Vector3f> contacts;
  std::vector<int> frames;
  double before = walking.phase();
  for (int i = 0; i < 60 * 14; ++i) {
    walking.advance(frame);
    const Eigen::Vector3f hips = root.advance(walking.pose());
    if (i > 120 && walking.phase() < before) contacts.push_back(hips), frames.push_back(i);
    before = walking.phase();
  }
  if (contacts.size() < 2) return 0;
  const Eigen::Vector3f way = contacts.back() - contacts.front();
  return std::hypot(way.x(), way.z()) * walking.scale() /
         ((frames.back() - frames.front()) * frame);
}

TEST(SpeedWalker, feet_travel_at_the_commanded_speed) {
  for (const char* subject : {"tall", "short"})
    for (int kmh = 1; kmh <= 10; ++kmh) {
      SpeedWalker walking = walker();
      walking.set_subject(subject);
      walking.set_speed(static_cast<float>(kmh) / 3.6f);
      walking.settle();
      EXPECT_NEAR(travelled_speed(walking) * 3.6 / kmh, 1, 0.01) << subject << ", " << kmh;
    }
}

// Up to 6.6 km/h these subjects walked. Beyond, the lines lead on to strides whose feet land faster
// than a foot can be stopped without a jerk.
TEST(SpeedWalker, stands_firmly_at_any_speed_that_was_walked_and_sinks_at_none) {
  const Model& model = *testing::speed_model();
  const JointRoles roles = body_roles(*model.body);
  for (double kmh = 1; kmh <= 10; ++kmh) {
    SpeedWalker walking = walker();
    walking.set_speed(static_cast<float>(kmh / 3.6));
    walking.settle();
    WalkRecorder recorder(*model.body, 1 / frame, walking.scale());
    std::vector<Contact> contacts;
    for (int i = -120; i < 600; ++i) {
      walking.advance(frame);
      if (i < 0) {
        recorder.lead_in(walking.pose());
        continue;
      }
      if (walking.contact()) contacts.push_back({i, *walking.contact()});
      recorder.add(walking.pose());
    }
    const Clip clip = recorder.clip("walked");
    const double slide = foot_slide(clip, roles, contacts).mean;
    const double lowest = testing::lowest_of(clip, roles);
    std::printf("%2.0f km/h: %.1f mm a stance, lowest point %.1f mm\n", kmh, slide, 1000 * lowest);
    EXPECT_GT(contacts.size(), 6u);
    EXPECT_LT(slide, kmh <= 7 ? 4 : 30) << kmh << " km/h";
    EXPECT_GT(lowest, -0.01) << kmh << " km/h";
  }
}

TEST(SpeedWalker, the_fitted_law_tells_at_which_speed_the_feet_really_go) {
  for (const float speed : {0.6f, 1.2f, 2.2f}) {
    SpeedWalker walking = walker();
    walking.set_subject("tall");
    walking.set_speed(speed);
    walking.settle();
    walking.advance(frame);
    const double of_feet = walking.frequency();
    walking.set_law(SpeedLaw::fitted);
    walking.settle();
    const double travelled = travelled_speed(walking);
    EXPECT_NEAR(walking.frequency() / of_feet * speed / travelled, 1, 0.015) << speed;
    EXPECT_FLOAT_EQ(walking.speed(), speed);
  }
}

TEST(SpeedWalker, frequency_follows_the_law_that_was_set) {
  SpeedWalker walking = walker();
  walking.set_subject("tall");
  walking.set_speed(1.38f);
  walking.set_law(SpeedLaw::inman);
  walking.settle();
  walking.advance(frame);
  EXPECT_NEAR(walking.frequency(), 0.743 * std::sqrt(1.38 / testing::tall_leg), 1e-4);
  EXPECT_NEAR(walking.phase(), std::fmod(0.7 + walking.frequency() * frame, 1.0), 1e-6);  // eq. 5
  walking.set_law(SpeedLaw::fitted);
  walking.settle();
  walking.advance(frame);
  const SpeedSpace& tall = testing::speed_model()->speed_spaces[1];
  EXPECT_NEAR(walking.frequency(),
              tall.frequency_scale * std::pow(1.38 / testing::tall_leg, tall.frequency_power),
              1e-4);
}

TEST(SpeedWalker, poses_are_those_of_the_lines) {
  // Feet on the ground cost the legs a little; above them nothing is changed.
  const Model& model = *testing::speed_model();
  const SpeedSpace& tall = model.speed_spaces[1];
  const CycleSpace& space = *model.shared_speed_space;
  SpeedWalker walking = walker();
  walking.set_subject("tall");
  const double v = 1.5;
  walking.set_speed(static_cast<float>(v * testing::tall_leg));
  walking.settle();
  const Eigen::VectorXd cycle =
      space.mean + space.components * (tall.shared.intercept + v * tall.shared.slope);
  const JointRoles roles = body_roles(*model.body);
  const int at = static_cast<int>(std::lround(walking.phase() * space.frames)) % space.frames;
  for (std::size_t i = 0; i < space.joints.size(); ++i) {
    const int joint = space.joints[i];
    const auto first = static_cast<std::size_t>(at) * 3 * space.joints.size() + 3 * i;
    const Eigen::Quaterniond wanted = rotation_from<double>(
        std::span<const double, 3>(cycle.data() + first, 3), model.body->references[joint]);
    const double limit = roles.in_leg.empty() && joint != roles.hips &&
                                 model.body->roles[joint] != Role::none &&
                                 model.body->roles[joint] < Role::left_thigh
                             ? 0.01
                             : 0.15;
    EXPECT_LT(angle_between<double>(walking.pose()[joint].cast<double>(), wanted), limit)
        << model.body->skeleton.joints[joint].name;
  }
}

TEST(SpeedWalker, who_stands_does_not_move) {
  SpeedWalker walking = walker();
  const Pose before = pose_of(walking);
  EXPECT_TRUE(walking.standing());
  walk(walking, 2);
  EXPECT_EQ(largest_turn(before, pose_of(walking)), 0);
  EXPECT_EQ(walking.frequency(), 0);
}

TEST(SpeedWalker, starts_from_standing_and_comes_to_a_stop_with_feet_together) {
  SpeedWalker walking = walker();
  const Pose still = pose_of(walking);
  walking.set_speed(1.4f);
  walk(walking, 0.3);
  EXPECT_GT(walking.speed(), 0);
  EXPECT_LT(walking.speed(), 1.2f);
  walk(walking, 3);
  EXPECT_FLOAT_EQ(walking.speed(), 1.4f);
  walking.set_speed(0);
  walk(walking, 0.3);
  EXPECT_GT(walking.speed(), 0.2f);
  walk(walking, 4);
  EXPECT_TRUE(walking.standing());
  EXPECT_LT(largest_turn(still, pose_of(walking)), 1e-3f);
}

// The fastest turn of any joint from frame to frame while walking steadily at this speed.
float fastest_turn(float speed) {
  SpeedWalker walking = walker();
  walking.set_speed(speed);
  walking.settle();
  float fastest = 0;
  for (int i = 0; i < 240; ++i) {
    const Pose before = pose_of(walking);
    walking.advance(frame);
    fastest = std::max(fastest, largest_turn(before, pose_of(walking)));
  }
  return fastest;
}

TEST(SpeedWalker, no_control_makes_it_jump) {
  const float usual = fastest_turn(2.0f);
  SpeedWalker walking = walker();
  float fastest = 0;
  for (int i = 0; i < 60 * 40; ++i) {
    if (i % 97 == 0) walking.set_speed(static_cast<float>(i % 5) * 0.5f);
    if (i % 61 == 0) walking.set_subject(i % 2 == 0 ? "tall" : "short");
    if (i % 131 == 0) walking.set_leg_length(0.7f + 0.1f * static_cast<float>(i % 4));
    if (i % 83 == 0) walking.set_law(static_cast<SpeedLaw>(i % 3));
    const Pose before = pose_of(walking);
    const float leg = walking.leg_length();
    walking.advance(frame);
    fastest = std::max(fastest, largest_turn(before, pose_of(walking)));
    EXPECT_LT(std::abs(walking.leg_length() - leg), 0.02f);
  }
  EXPECT_LT(fastest, 1.3f * usual);
}

TEST(SpeedWalker, long_legs_walk_as_short_ones_at_the_same_speed_per_leg) {
  SpeedWalker one = walker(), twice = walker();
  one.set_subject("tall");
  one.set_leg_length(0.7f);
  one.set_speed(0.8f);
  one.settle();
  twice.set_subject("tall");
  twice.set_leg_length(1.4f);
  twice.set_speed(1.6f);
  twice.settle();
  for (int i = 0; i < 100; ++i) one.advance(frame), twice.advance(frame);
  EXPECT_LT(largest_turn(pose_of(one), pose_of(twice)), 1e-4f);
  EXPECT_NEAR(twice.scale() / one.scale(), 2, 1e-5);
}

TEST(SpeedWalker, a_child_steps_faster_than_a_giant_at_the_same_speed) {
  SpeedWalker child = walker(), giant = walker();
  child.set_leg_length(0.5f);
  giant.set_leg_length(1.2f);
  for (SpeedWalker* one : {&child, &giant}) {
    one->set_speed(1.2f);
    one->settle();
    one->advance(frame);
  }
  EXPECT_GT(child.frequency(), 1.3f * giant.frequency());
}

TEST(SpeedWalker, walks_between_two_subjects) {
  SpeedWalker tall = walker(), small = walker(), between = walker();
  tall.set_subject("tall");
  small.set_subject("short");
  EXPECT_EQ(between.set_weights(std::vector<float>{3, 3}), ControlResult::as_given);
  for (SpeedWalker* one : {&tall, &small, &between}) {
    one->set_leg_length(0.8f);
    one->set_speed(1.3f);
    one->settle();
  }
  const float far = largest_turn(pose_of(tall), pose_of(small));
  EXPECT_GT(far, 0.005f);
  EXPECT_LT(largest_turn(pose_of(tall), pose_of(between)), 0.6f * far);
  EXPECT_LT(largest_turn(pose_of(small), pose_of(between)), 0.6f * far);
}

TEST(SpeedWalker, controls_out_of_range_are_clamped_with_a_word) {
  SpeedWalker walking = walker();
  EXPECT_EQ(walking.set_speed(5), ControlResult::clamped);
  walking.settle();
  EXPECT_NEAR(walking.speed(), 10 / 3.6, 1e-5);
  EXPECT_EQ(walking.set_speed(-1), ControlResult::clamped);
  EXPECT_EQ(walking.set_speed(1.5f), ControlResult::as_given);
  EXPECT_EQ(walking.set_leg_length(0.01f), ControlResult::clamped);
  EXPECT_EQ(walking.set_speed(2.5f), ControlResult::clamped) << "too fast for legs of 0.3 m";
  EXPECT_EQ(walking.set_leg_length(0.9f), ControlResult::as_given);
}

TEST(SpeedWalker, controls_that_are_no_numbers_change_nothing) {
  SpeedWalker walking = walker(), untouched = walker();
  walking.set_speed(1.1f);
  untouched.set_speed(1.1f);
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
        -std::numeric_limits<float>::infinity()}) {
    EXPECT_EQ(walking.set_speed(bad), ControlResult::refused);
    EXPECT_EQ(walking.set_leg_length(bad), ControlResult::refused);
    EXPECT_EQ(walking.set_weights(std::vector<float>{1, bad}), ControlResult::refused);
    walking.advance(bad);
  }
  EXPECT_EQ(walking.set_weights(std::vector<float>{1}), ControlResult::refused);
  EXPECT_EQ(walking.set_weights(std::vector<float>{0, 0}), ControlResult::refused);
  EXPECT_EQ(walking.set_weights(std::vector<float>{2, -1}), ControlResult::refused);
  EXPECT_EQ(walking.set_subject("nobody"), ControlResult::refused);
  walking.advance(-1);
  walk(walking, 1);
  walk(untouched, 1);
  EXPECT_EQ(largest_turn(pose_of(walking), pose_of(untouched)), 0);
}

TEST(SpeedWalker, walks_the_same_at_any_frame_rate) {
  SpeedWalker at_30 = walker(), at_120 = walker();
  for (SpeedWalker* one : {&at_30, &at_120}) {
    one->set_speed(1.5f);
    one->settle();
  }
  for (int i = 0; i < 30 * 10; ++i) at_30.advance(1.0 / 30);
  for (int i = 0; i < 120 * 10; ++i) at_120.advance(1.0 / 120);
  EXPECT_NEAR(std::remainder(at_30.phase() - at_120.phase(), 1.0), 0, 1e-5);
}

TEST(SpeedWalker, takes_no_memory_while_it_walks) {
  if (!testing::ForbiddenMemory::works()) GTEST_SKIP() << "sanitizers bring their own memory";
  SpeedWalker walking = walker();
  const std::vector<float> weights{1, 2};
  long taken = 0, given = 0;
  {
    const testing::ForbiddenMemory forbidden;
    for (int i = 0; i < 600; ++i) {
      walking.set_speed(static_cast<float>(i % 7) * 0.3f);
      walking.set_leg_length(0.7f + static_cast<float>(i % 3) * 0.1f);
      walking.set_weights(weights);
      if (i % 50 == 0) walking.set_subject("short");
      walking.set_law(static_cast<SpeedLaw>(i % 3));
      walking.advance(frame);
    }
    walking.settle();
    walking.reset();
    taken = forbidden.allocations();
    given = forbidden.releases();
  }
  EXPECT_EQ(taken, 0);
  EXPECT_EQ(given, 0);
}

TEST(SpeedWalker, walks_alike_whatever_joints_lie_between_hip_and_ankle) {
  std::vector<Walk> walks = testing::walks_over_speed();
  for (Walk& walk : walks) walk.clip = testing::with_joints_in_legs(walk.clip);
  const auto model = testing::speed_model(walks);
  const auto split = make_speed_tables(*model);
  EXPECT_NEAR(split->leg_length, tables()->leg_length, 1e-6);
  for (std::size_t i = 0; i < split->subjects.size(); ++i) {
    EXPECT_NEAR(split->subjects[i].leg_length, tables()->subjects[i].leg_length, 1e-6);
    for (const float v : {0.5f, 1.5f, 2.5f})
      EXPECT_NEAR(stride_at(split->subjects[i], v), stride_at(tables()->subjects[i], v), 1e-3);
  }
  SpeedWalker walking(split);
  walking.set_subject("tall");
  walking.set_speed(4 / 3.6f);
  walking.settle();
  EXPECT_NEAR(walking.leg_length(), testing::tall_leg, 1e-6);
  EXPECT_NEAR(travelled_speed(walking, *model) * 3.6 / 4, 1, 0.01);
}

TEST(SpeedWalker, one_subject_walks_without_a_shared_space) {
  std::vector<Walk> walks = testing::walks_over_speed();
  std::erase_if(walks, [](const Walk& walk) { return walk.subject != "tall"; });
  const auto model = testing::speed_model(walks);
  ASSERT_FALSE(model->shared_speed_space);
  SpeedWalker walking(make_speed_tables(*model));
  walking.set_speed(1.3f);
  walking.settle();
  EXPECT_NEAR(travelled_speed(walking, *model), 1.3, 0.013);
}

TEST(SpeedWalker, a_model_without_speeds_says_how_to_get_some) {
  try {
    PlayModel(std::make_shared<Model>()).speeds();
    FAIL() << "walked without speeds";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("train"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace gait
