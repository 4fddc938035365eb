#include "gait/motion/heading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gait/motion/contacts.h"
#include "motion/walked_ways.h"

namespace gait {
namespace {

using testing::around;
using testing::backwards;
using testing::on_treadmill;
using testing::turned;
using testing::walk_in;

constexpr double degree = std::numbers::pi / 180;

std::vector<double> heading_of(const Clip& clip) {
  return follow_walk(clip, find_roles(clip.skeleton)).heading;
}

// Largest angle between the heading and a direction over all frames.
double largest_error(const std::vector<double>& heading, double direction) {
  double largest = 0;
  for (const double angle : heading)
    largest = std::max(largest, std::abs(std::remainder(angle - direction, 2 * std::numbers::pi)));
  return largest;
}

TEST(Heading, is_the_way_a_straight_walk_goes_whichever_it_is) {
  const Clip ahead = walk_in("proud").clip;
  for (int i = -5; i <= 6; ++i) {
    const double direction = i * 30 * degree;
    EXPECT_LT(largest_error(heading_of(turned(ahead, direction)), direction), 3 * degree) << i * 30;
  }
}

TEST(Heading, of_every_style_is_straight_ahead) {
  // The drunk do not walk straight, but straighter than a cycle space would refuse.
  for (const WalkStyle& style : corpus_styles())
    EXPECT_LT(largest_error(heading_of(walk_in(style.name).clip), 0),
              (style.name == "drunk" ? 8 : 4) * degree)
        << style.name;
}

TEST(Heading, of_who_walks_backwards_is_where_the_face_looks) {
  const Clip clip = backwards(walk_in("decided").clip);
  EXPECT_LT(largest_error(heading_of(clip), 0), 3 * degree);
  EXPECT_LT(largest_error(heading_of(turned(clip, 2)), 2), 3 * degree);
}

TEST(Heading, on_a_treadmill_is_where_the_body_faces) {
  const Clip clip = on_treadmill(walk_in("proud").clip);
  EXPECT_LT(largest_error(heading_of(turned(clip, -1.2)), -1.2), 6 * degree);
}

TEST(Heading, goes_round_with_a_circle_and_never_jumps) {
  const double radius = 1.2;
  const CorpusWalk walk = walk_in("proud", 8);
  const Clip clip = around(walk.clip, radius);
  const std::vector<double> heading = heading_of(clip);
  const double way = clip.frames() / clip.frame_rate *
                     follow_walk(walk.clip, find_roles(walk.clip.skeleton)).speed;
  ASSERT_GT(way / radius, std::numbers::pi) << "the circle passes the half turn";
  // Half a cycle in, for at the ends the window is the first or last whole one.
  for (int frame = 20; frame + 20 < clip.frames(); ++frame) {
    EXPECT_LT(std::abs(heading[frame] - heading[frame - 1]), 0.1);
    const double expected = walk.clip.translation(frame)[0].z() / radius;
    EXPECT_NEAR(std::remainder(heading[frame] - expected, 2 * std::numbers::pi), 0, 0.12) << frame;
  }
}

TEST(CausalHeading, is_the_mean_direction_of_the_last_cycle) {
  CausalHeading<float> heading(4);
  // From the right thigh to the left along +X: Y up and right-handed, the body faces +Z.
  const Vector3<float> across(1, 0, 0);
  for (int i = 0; i < 10; ++i) EXPECT_NEAR(heading.advance(across), 0, 1e-6);
  const Quaternion<float> turn = about_vertical(0.4f);
  EXPECT_NEAR(heading.advance(turn * across), 0.1, 0.01) << "one frame of four";
  EXPECT_NEAR(heading.advance(turn * across), 0.2, 0.01);
  heading.advance(turn * across);
  EXPECT_NEAR(heading.advance(turn * across), 0.4, 1e-6);
  heading.reset();
  EXPECT_NEAR(heading.advance(about_vertical(-2.0f) * across), -2, 1e-6);
}

TEST(CausalHeading, weighs_every_frame_alike_and_survives_one_without_direction) {
  CausalHeading<double> heading(3);
  heading.advance({0.001, 0, 0});
  EXPECT_NEAR(heading.advance(about_vertical(1.0) * Vector3<double>(50, 0, 0)), 0.5, 1e-9);
  EXPECT_NEAR(heading.advance({0, 1, 0}), 0.5, 1e-9) << "straight up says nothing";
  EXPECT_TRUE(std::isfinite(CausalHeading<double>(0).advance({0, 0, 0})));
}

TEST(CausalHeading, is_the_same_over_seconds_as_over_frames_at_a_fixed_rate) {
  CausalHeading<double> frames(33), seconds = CausalHeading<double>::over_seconds(1.1, 512);
  for (int i = 0; i < 200; ++i) {
    const Vector3<double> across = about_vertical(std::sin(0.1 * i)) * Vector3<double>(1, 0, 0);
    EXPECT_NEAR(seconds.advance(across, i / 30.0), frames.advance(across), 1e-12) << i;
  }
  EXPECT_NEAR(seconds.advance(about_vertical(2.0) * Vector3<double>(1, 0, 0), 0), 2, 1e-12)
      << "time that goes back begins anew";
}

}  // namespace
}  // namespace gait
