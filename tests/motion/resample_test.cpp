#include "gait/motion/resample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/motion/rotation.h"
#include "shared_data.h"

namespace gait {
namespace {

// Two joints; the child turns at a constant 2 rad/s, the root moves at a constant speed.
Clip turning(int frames, double rate) {
  Clip clip;
  clip.name = "turning";
  clip.frame_rate = rate;
  clip.skeleton.joints = {{"hips", -1, {0, 0, 0}, {}}, {"thigh", 0, {0, -0.1, 0}, {{0, -0.4, 0}}}};
  clip.resize(frames);
  for (int frame = 0; frame < frames; ++frame) {
    clip.translation(frame)[0] = Eigen::Vector3d(0.3, 1, -1.2) * (frame / rate);
    clip.pose(frame)[1] =
        exponential_map<double>(Eigen::Vector3d(1, 2, 2) / 3 * (2.0 * frame / rate));
  }
  return clip;
}

TEST(Resample, thirty_from_a_hundred_and_twenty_picks_every_fourth_frame) {
  for (const double written : {120.0, 1 / 0.0083333, 1 / 0.008333}) {
    const Clip clip = turning(2001, written);
    const Clip slow = resampled(clip, 30);
    ASSERT_EQ(slow.frames(), 501);
    EXPECT_EQ(slow.frame_rate, 30);
    for (int frame = 0; frame < slow.frames(); ++frame)
      for (int joint = 0; joint < 2; ++joint) {
        EXPECT_EQ(slow.pose(frame)[joint].coeffs(), clip.pose(4 * frame)[joint].coeffs());
        EXPECT_EQ(slow.translation(frame)[joint], clip.translation(4 * frame)[joint]);
      }
  }
}

TEST(Resample, the_same_rate_gives_the_same_frames) {
  const Clip clip = turning(777, 1 / 0.0333333);
  const Clip same = resampled(clip, 30);
  EXPECT_EQ(same.frames(), clip.frames());
  for (std::size_t i = 0; i < clip.rotations.size(); ++i)
    EXPECT_EQ(same.rotations[i].coeffs(), clip.rotations[i].coeffs());
}

TEST(Resample, frames_in_between_lie_where_the_motion_was) {
  for (const double from : {24.0, 30.0, 60.0, 120.0})
    for (const double to : {25.0, 30.0, 50.0, 90.0, 119.0}) {
      const Clip clip = turning(240, from);
      const Clip other = resampled(clip, to);
      const Clip direct = turning(other.frames(), to);
      EXPECT_LE((other.frames() - 1) / to, 239 / from + 1e-9);
      EXPECT_GT(other.frames() / to, 239 / from);
      for (std::size_t i = 0; i < other.rotations.size(); ++i) {
        EXPECT_LT(angle_between(other.rotations[i], direct.rotations[i]), 1e-7);
        EXPECT_LT((other.translations[i] - direct.translations[i]).norm(), 1e-9);
      }
    }
}

TEST(Resample, three_times_the_rate_and_back_is_the_same_clip) {
  const Clip clip = turning(400, 30);
  const Clip there = resampled(clip, 90);
  EXPECT_EQ(there.frames(), 3 * 399 + 1);
  const Clip back = resampled(there, 30);
  ASSERT_EQ(back.frames(), clip.frames());
  for (std::size_t i = 0; i < clip.rotations.size(); ++i)
    EXPECT_EQ(back.rotations[i].coeffs(), clip.rotations[i].coeffs());
}

TEST(Resample, clips_of_no_or_one_frame_stay_so) {
  EXPECT_EQ(resampled(turning(0, 30), 60).frames(), 0);
  EXPECT_EQ(resampled(turning(1, 30), 60).frames(), 1);
}

TEST(Resample, a_rate_that_is_none_is_an_error_that_says_so) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double rate : {0.0, -30.0, nan, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(resampled(turning(5, 30), rate), Error);
    Clip clip = turning(5, 30);
    clip.frame_rate = rate;
    EXPECT_THROW(resampled(clip, 30), Error);
  }
}

TEST(Resample, a_captured_walk_at_thirty_and_back_stays_within_what_a_frame_can_hide) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  const Clip clip = clip_from_bvh(read_bvh(testing::shared_data() / "cmu-walks" / "08_01.bvh"));
  const Clip back = resampled(resampled(clip, 30), 120);
  ASSERT_GT(back.frames(), clip.frames() - 4);
  // Hands and toes flicker in the capture; what carries the walk does not.
  for (const char* name : {"Hips", "LeftUpLeg", "RightUpLeg", "LeftLeg", "RightLeg", "Spine"}) {
    const int joint = clip.skeleton.find(name);
    ASSERT_GE(joint, 0) << name;
    double sum = 0;
    for (int frame = 0; frame < back.frames(); ++frame)
      sum += angle_between(back.pose(frame)[joint], clip.pose(frame)[joint]);
    EXPECT_LT(sum / back.frames(), 0.01)
        << name;  // 0.6 degrees, of which most is the capture's noise
  }
}

}  // namespace
}  // namespace gait
