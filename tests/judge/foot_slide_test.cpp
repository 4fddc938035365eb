#include "gait/judge/foot_slide.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/motion/body_frame.h"
#include "gait/motion/contacts.h"
#include "gait/motion/rotation.h"
#include "shared_data.h"

namespace gait {
namespace {

// Feet hang from the hips by one bone each; the toe base is 0.2 m ahead of the ankle and as high.
struct Feet {
  Clip clip;
  JointRoles roles;

  explicit Feet(int frames) {
    clip.name = "feet";
    clip.skeleton.joints = {{"hips", -1, {0, 0, 0}, {}},
                            {"right foot", 0, {-0.1, -1, 0}, {}},
                            {"right toes", 1, {0, 0, 0.2}, {{0, 0, 0.1}}},
                            {"left foot", 0, {0.1, -1, 0}, {}},
                            {"left toes", 3, {0, 0, 0.2}, {{0, 0, 0.1}}}};
    roles.hips = 0;
    roles.right.foot = 1, roles.right.toes = 2;
    roles.left.foot = 3, roles.left.toes = 4;
    clip.resize(frames);
    for (int frame = 0; frame < frames; ++frame) clip.translation(frame)[0].y() = 1;
  }
  void pitch(int frame, int joint, double angle) {
    clip.pose(frame)[joint] = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX());
  }
};

TEST(FootSlide, a_body_that_stands_does_not_slide) {
  const Feet feet(50);
  const FootSlide slide = foot_slide(feet.clip, feet.roles, {{5, Foot::right}, {30, Foot::left}});
  ASSERT_EQ(slide.stances.size(), 1u);
  EXPECT_EQ(slide.mean, 0);
}

TEST(FootSlide, a_dragged_foot_slides_as_far_as_it_is_dragged_whatever_its_height) {
  Feet feet(60);
  for (int frame = 0; frame < 60; ++frame) {
    feet.clip.translation(frame)[0] += Eigen::Vector3d(0.003, 0, 0.004) * frame;  // 5 mm a frame
    feet.clip.translation(frame)[0].y() += 0.01 * frame;
  }
  const FootSlide slide =
      foot_slide(feet.clip, feet.roles, {{10, Foot::right}, {30, Foot::left}, {40, Foot::right}});
  ASSERT_EQ(slide.stances.size(), 2u);
  EXPECT_NEAR(slide.stances[0], 19 * 5, 1e-9);  // from frame 10 to 29
  EXPECT_NEAR(slide.stances[1], 9 * 5, 1e-9);
  EXPECT_NEAR(slide.mean, 70, 1e-9);
}

TEST(FootSlide, going_there_and_back_counts_twice) {
  Feet feet(21);
  for (int frame = 0; frame < 21; ++frame)
    feet.clip.translation(frame)[0].x() = 0.01 * (10 - std::abs(10 - frame));
  EXPECT_NEAR(foot_slide(feet.clip, feet.roles, {{0, Foot::left}, {20, Foot::right}}).mean,
              1000 * 0.01 * 19, 1e-9);
}

TEST(FootSlide, only_the_foot_that_stands_counts) {
  Feet feet(40);
  for (int frame = 0; frame < 40; ++frame) feet.clip.translation(frame)[3].z() = 0.05 * frame;
  EXPECT_EQ(foot_slide(feet.clip, feet.roles, {{0, Foot::right}, {30, Foot::left}}).mean, 0);
  EXPECT_GT(foot_slide(feet.clip, feet.roles, {{0, Foot::left}, {30, Foot::right}}).mean, 1000);
}

TEST(FootSlide, rolling_from_the_ankle_to_the_toes_is_no_slide) {
  // First about the ankle with the toes up, then about the tip of the toes with the ankle up.
  Feet feet(41);
  for (int frame = 0; frame <= 40; ++frame) {
    const double angle = 0.02 * (frame - 20);
    feet.pitch(frame, 1, angle);
    if (angle <= 0) continue;
    const Eigen::Vector3d tip(0, 0, 0.3);
    feet.clip.translation(frame)[0] +=
        tip - Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()) * tip;
  }
  EXPECT_NEAR(foot_slide(feet.clip, feet.roles, {{0, Foot::right}, {40, Foot::left}}).mean, 0,
              1e-9);
  // Held by the ankle instead, the toes scrape backward by 0.3 m (1 - cos) over their half.
  for (int frame = 0; frame <= 40; ++frame) {
    feet.clip.translation(frame)[0] = {0, 1, 0};
  }
  EXPECT_NEAR(foot_slide(feet.clip, feet.roles, {{0, Foot::right}, {40, Foot::left}}).mean,
              300 * (std::cos(0.02) - std::cos(0.38)), 1e-6);
}

TEST(FootSlide, contacts_that_make_no_step_make_no_stance) {
  const Feet feet(50);
  EXPECT_TRUE(foot_slide(feet.clip, feet.roles, {}).stances.empty());
  EXPECT_TRUE(foot_slide(feet.clip, feet.roles, {{3, Foot::left}}).stances.empty());
  EXPECT_TRUE(
      foot_slide(feet.clip, feet.roles, {{3, Foot::left}, {9, Foot::left}}).stances.empty());
}

TEST(FootSlide, a_missing_foot_or_a_contact_outside_the_clip_is_an_error) {
  Feet feet(50);
  EXPECT_THROW(foot_slide(feet.clip, feet.roles, {{3, Foot::left}, {50, Foot::right}}), Error);
  EXPECT_THROW(foot_slide(feet.clip, feet.roles, {{-1, Foot::left}, {5, Foot::right}}), Error);
  feet.roles.left.foot = -1;
  EXPECT_THROW(foot_slide(feet.clip, feet.roles, {}), Error);
}

TEST(FootSlide, a_captured_walk_slides_by_centimetres_and_a_treadmill_of_it_by_its_steps) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-2");
  const Clip file = clip_from_bvh(
      read_bvh(testing::shared_data() / "bandai-namco-2" / "dataset-2_walk_normal_001.bvh"));
  const JointRoles roles = find_roles(file.skeleton);
  Clip clip = in_metres_y_up(file, guess_body_frame(file, roles));
  const WalkTrack track = follow_walk(clip, roles);
  const double captured = foot_slide(clip, roles, track.contacts).mean;
  EXPECT_GT(captured, 5);
  EXPECT_LT(captured, 150);  // contacts are where a foot is farthest ahead, before it has settled

  // Held in place, the feet slide back by about what the body went per step.
  for (int frame = 0; frame < clip.frames(); ++frame) {
    const Eigen::Vector3d hips =
        track.world.positions[static_cast<std::size_t>(frame) * clip.skeleton.size() + roles.hips];
    clip.translation(frame)[0].x() -= hips.x();
    clip.translation(frame)[0].z() -= hips.z();
  }
  const double step = 1000 * track.speed * track.cycle_seconds / 2;
  EXPECT_NEAR(foot_slide(clip, roles, track.contacts).mean, step, 0.25 * step);
}

}  // namespace
}  // namespace gait
