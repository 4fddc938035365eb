// The style walker as a performer meets it: its controls, and that it can be relied upon.
#include "gait/play/cycles/style_walker.h"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

#include "gait/error.h"
#include "gait/model/model_file.h"
#include "gait/motion/rotation.h"
#include "play/cycles/styled_walks.h"
#include "play/forbidden_memory.h"

namespace gait {
namespace {

using testing::corpus_walks;
using testing::style_named;

using Poses = std::vector<std::vector<Eigen::Quaternionf>>;

const std::shared_ptr<const Model>& model() { return corpus_walks().model; }
int style(const std::string& name) { return style_named(*model(), name); }

Poses walk(StyleWalker& walker, int frames, double rate = 60) {
  Poses poses;
  for (int frame = 0; frame < frames; ++frame) {
    if (frame > 0) walker.advance(1 / rate);
    poses.emplace_back(walker.pose().begin(), walker.pose().end());
  }
  return poses;
}

bool same(const Poses& a, const Poses& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < a[i].size(); ++k)
      if (a[i][k].coeffs() != b[i][k].coeffs()) return false;
  return true;
}

float furthest(const std::vector<Eigen::Quaternionf>& a, const std::vector<Eigen::Quaternionf>& b) {
  float angle = 0;
  for (std::size_t k = 0; k < a.size(); ++k) angle = std::max(angle, angle_between(a[k], b[k]));
  return angle;
}

Poses walk_of_seed(std::uint64_t seed) {
  StyleWalker walker(model(), seed);
  walker.set_style(style("drunk"));
  return walk(walker, 300);
}

TEST(StyleWalker, walks_the_same_walk_with_the_same_seed_and_another_with_another) {
  EXPECT_TRUE(same(walk_of_seed(4), walk_of_seed(4)));
  EXPECT_FALSE(same(walk_of_seed(4), walk_of_seed(5)));
}

TEST(StyleWalker, walks_the_same_walk_on_any_number_of_threads) {
  std::vector<Poses> walks(6);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < walks.size(); ++i)
    threads.emplace_back([&walks, i] { walks[i] = walk_of_seed(i % 2); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < walks.size(); ++i) EXPECT_TRUE(same(walks[i], walk_of_seed(i % 2)));
}

TEST(StyleWalker, walks_the_same_walk_after_restart_and_in_whatever_order_it_was_set_up) {
  StyleWalker walker(model(), 9);
  walker.set_style(style("sad"));
  walker.set_variation(0.5f);
  const Poses first = walk(walker, 200);
  walker.restart(9);
  EXPECT_TRUE(same(first, walk(walker, 200)));

  StyleWalker other(model(), 9);
  other.set_variation(0.5f);
  other.set_style(style("proud"));
  other.set_style(style("sad"));
  EXPECT_TRUE(same(first, walk(other, 200)));
}

TEST(StyleWalker, walks_the_same_walk_from_a_model_that_was_written_and_read_again) {
  const auto read = std::make_shared<const Model>(parse_model(model_bytes(*model()), "walks"));
  StyleWalker a(model(), 3), b(read, 3);
  for (StyleWalker* walker : {&a, &b}) walker->set_style(style("cool"));
  EXPECT_TRUE(same(walk(a, 300), walk(b, 300)));
}

// T10's eq. 3 as it stands: the whole cycle from its scores in double, then two of its frames.
TEST(StyleWalker, poses_are_those_of_the_whole_cycle_made_from_its_scores) {
  const CycleSpace& space = model()->style_space->space;
  StyleWalker walker(model(), 6);
  walker.set_style(style("manly"));
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXd cycle = space.mean + space.components * walker.scores().cast<double>();
    const double at = walker.phase() * space.frames;
    const int first = static_cast<int>(at), second = (first + 1) % space.frames;
    // The last fifth is bent to close the cycle.
    for (std::size_t k = 0; second <= 32 && second > 0 && k < space.joints.size(); ++k) {
      const auto rotation = [&](int frame) {
        const Eigen::Index place = (frame * static_cast<int>(space.joints.size()) + k) * 3;
        return Eigen::Quaterniond(model()->body->references[space.joints[k]] *
                                  exponential_map<double>(cycle.segment<3>(place)));
      };
      const Eigen::Quaterniond wanted = slerp(rotation(first), rotation(second), at - first);
      EXPECT_LT(
          angle_between<double>(wanted, walker.pose()[space.joints[k]].cast<double>().normalized()),
          2e-5);
    }
    walker.advance(1 / 70.0);
  }
}

TEST(StyleWalker, without_variation_walks_the_mean_cycle_for_ever) {
  StyleWalker walker(model(), 6);
  walker.set_style(style("drunk"));
  walker.set_variation(0);
  const StyleCycles& told = model()->style_space->styles[style("drunk")];
  for (int i = 0; i < 500; ++i) {
    for (int k = 0; k < walker.components(); ++k)
      EXPECT_NEAR(walker.scores()[k], told.scores[k].mean, 1e-5);
    EXPECT_NEAR(walker.duration(), told.duration.mean, 1e-5);
    walker.advance(1 / 50.0);
  }
}

TEST(StyleWalker, a_score_held_by_hand_stays_until_it_is_set_free) {
  StyleWalker walker(model(), 6);
  walker.set_style(style("proud"));
  walk(walker, 50);
  ASSERT_TRUE(walker.pin(2, 1.5f));
  walk(walker, 120);
  const float wanted =
      1.5f * static_cast<float>(std::sqrt(model()->style_space->space.variances[2]));
  for (int i = 0; i < 200; ++i) {
    EXPECT_NEAR(walker.scores()[2], wanted, 0.01f * wanted);
    walker.advance(1 / 60.0);
  }
  ASSERT_TRUE(walker.free(2));
  walk(walker, 200);
  const Variation& told = model()->style_space->styles[style("proud")].scores[2];
  EXPECT_NEAR(walker.scores()[2], told.mean, 6 * told.deviation);
}

TEST(StyleWalker, exaggeration_moves_along_the_line_from_the_mean_of_all_styles) {
  StyleWalker walker(model(), 6);
  walker.set_style(style("sad"));
  walker.set_variation(0);
  const auto scores = [&](float exaggeration) {
    walker.set_exaggeration(exaggeration);
    return Eigen::VectorXf(walker.scores());
  };
  const Eigen::VectorXf none = scores(0), whole = scores(1), twice = scores(2);
  EXPECT_LT((twice - whole - (whole - none)).norm(), 1e-4f * whole.norm());
  Eigen::VectorXf mean = Eigen::VectorXf::Zero(none.size());
  for (const StyleCycles& told : model()->style_space->styles)
    for (Eigen::Index k = 0; k < mean.size(); ++k)
      mean[k] += static_cast<float>(told.scores[static_cast<std::size_t>(k)].mean) /
                 static_cast<float>(model()->styles.size());
  EXPECT_LT((none - mean).norm(), 1e-4f * whole.norm());
}

TEST(StyleWalker, cadence_can_be_set) {
  StyleWalker walker(model(), 6);
  walker.set_style(style("decided"));
  const float own = walker.cadence();
  EXPECT_NEAR(own, 2 / walker.duration(), 1e-5f);
  ASSERT_TRUE(walker.set_cadence(1.6f));
  int contacts = 0;
  for (int i = 0; i < 6000; ++i) {
    walker.advance(1 / 100.0);
    contacts += walker.contact().has_value();
  }
  EXPECT_NEAR(contacts, 96, 1);
  ASSERT_TRUE(walker.set_cadence(0));
  EXPECT_NEAR(walker.cadence(), 2 / walker.duration(), 1e-5f);
}

TEST(StyleWalker, says_which_foot_met_the_ground_and_when) {
  StyleWalker walker(model(), 6);
  Foot next = Foot::left;
  int contacts = 0;
  double before = 0;
  for (int i = 0; i < 3000; ++i) {
    walker.advance(1 / 44.0);
    EXPECT_EQ(walker.contact().has_value(), (before < 0.5) != (walker.phase() < 0.5));
    if (walker.contact()) {
      EXPECT_EQ(*walker.contact(), next);
      EXPECT_GE(walker.since_contact(), 0);
      EXPECT_LT(walker.since_contact(), 1 / 44.0 + 1e-9);
      next = other(next);
      ++contacts;
    }
    before = walker.phase();
  }
  EXPECT_EQ(contacts / 2, walker.cycle());
}

TEST(StyleWalker, a_control_that_cannot_be_set_changes_nothing) {
  StyleWalker walker(model(), 6), untouched(model(), 6);
  for (StyleWalker* w : {&walker, &untouched}) w->set_style(style("sad"));
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              inf = std::numeric_limits<float>::infinity();
  const auto refuse = [&] {
    for (const float strange : {nan, inf, -inf}) {
      EXPECT_FALSE(walker.set_variation(strange));
      EXPECT_FALSE(walker.set_exaggeration(strange));
      EXPECT_FALSE(walker.set_cadence(strange));
      EXPECT_FALSE(walker.pin(0, strange));
      EXPECT_FALSE(walker.advance(strange));
      std::vector<float> weights(model()->styles.size(), 1);
      weights[3] = strange;
      EXPECT_FALSE(walker.set_weights(weights));
    }
    EXPECT_FALSE(walker.advance(-0.01));
    EXPECT_FALSE(walker.pin(-1, 0));
    EXPECT_FALSE(walker.pin(walker.components(), 0));
    EXPECT_FALSE(walker.free(walker.components()));
    EXPECT_FALSE(walker.set_style(-1));
    EXPECT_FALSE(walker.set_style(static_cast<int>(model()->styles.size())));
    EXPECT_FALSE(walker.set_weights(std::vector<float>(model()->styles.size(), 0)));
    EXPECT_FALSE(walker.set_weights(std::vector<float>{1}));
  };
  refuse();
  for (int i = 0; i < 60; ++i) {
    walker.advance(1 / 60.0), untouched.advance(1 / 60.0);
    refuse();
    for (std::size_t k = 0; k < walker.pose().size(); ++k)
      ASSERT_EQ(walker.pose()[k].coeffs(), untouched.pose()[k].coeffs());
  }
}

TEST(StyleWalker, controls_out_of_range_are_clamped) {
  StyleWalker walker(model(), 6), clamped(model(), 6);
  EXPECT_TRUE(walker.set_variation(50) && clamped.set_variation(2));
  EXPECT_TRUE(walker.set_exaggeration(-9) && clamped.set_exaggeration(-1));
  EXPECT_TRUE(walker.pin(1, 1e30f) && clamped.pin(1, 6));
  EXPECT_TRUE(walker.set_cadence(1e30f) && clamped.set_cadence(8));
  EXPECT_TRUE(same(walk(walker, 100), walk(clamped, 100)));
}

TEST(StyleWalker, whatever_is_done_to_it_poses_stay_poses) {
  StyleWalker walker(model(), 6);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> any(-2, 5);
  for (int i = 0; i < 20000; ++i) {
    switch (random() % 12) {
      case 0:
        walker.set_style(static_cast<int>(random() % 11));
        break;
      case 1:
        walker.set_variation(any(random));
        break;
      case 2:
        walker.set_exaggeration(any(random));
        break;
      case 3:
        walker.pin(static_cast<int>(random() % 20), any(random));
        break;
      case 4:
        walker.free(static_cast<int>(random() % 20));
        break;
      case 5:
        walker.set_cadence(any(random));
        break;
      case 6:
        walker.set_through_neutral(random() % 2 == 0);
        break;
      default:
        break;
    }
    ASSERT_TRUE(
        walker.advance(random() % 50 == 0 ? 1e6 : 0.002 * static_cast<double>(random() % 30)));
    ASSERT_GE(walker.phase(), 0);
    ASSERT_LT(walker.phase(), 1);
    for (const Eigen::Quaternionf& rotation : walker.pose()) ASSERT_NEAR(rotation.norm(), 1, 1e-4f);
  }
}

// From one frame to the next nothing turns faster than in the wildest walk, however controls jump.
TEST(StyleWalker, never_jumps_when_it_is_played_with) {
  float fastest = 0;
  for (std::size_t i = 0; i < model()->styles.size(); ++i) {
    StyleWalker walker(model(), i);
    walker.set_style(static_cast<int>(i));
    const Poses poses = walk(walker, 600, 120);
    for (std::size_t f = 1; f < poses.size(); ++f)
      fastest = std::max(fastest, furthest(poses[f - 1], poses[f]));
  }
  StyleWalker walker(model(), 1);
  walker.set_style(style("sad"));
  std::vector<Eigen::Quaternionf> before(walker.pose().begin(), walker.pose().end());
  for (int frame = 0; frame < 1200; ++frame) {
    if (frame % 150 == 50) walker.set_style(style("in-a-hurry"));
    if (frame % 150 == 125) walker.set_style(style("sad"));
    if (frame == 400) walker.set_variation(2);
    if (frame == 700) walker.pin(3, 1);
    if (frame == 900) walker.free(3);
    walker.advance(1 / 120.0);
    std::vector<Eigen::Quaternionf> now(walker.pose().begin(), walker.pose().end());
    EXPECT_LT(furthest(before, now), 1.5f * fastest) << "at frame " << frame;
    before = std::move(now);
  }
}

TEST(StyleWalker, takes_no_memory_while_it_walks) {
  if (!testing::ForbiddenMemory::works()) GTEST_SKIP() << "a sanitizer has malloc";
  StyleWalker walker(model(), 6);
  std::vector<float> weights(model()->styles.size(), 1);
  const testing::ForbiddenMemory forbidden;
  for (int i = 0; i < 2000; ++i) {
    if (i % 100 == 0) walker.set_style(i / 100 % 11);
    if (i % 170 == 0) walker.set_weights(weights);
    if (i % 130 == 0) walker.pin(1, 0.5f), walker.set_variation(0.7f);
    if (i == 1000) walker.restart(7);
    walker.advance(1 / 60.0);
  }
  EXPECT_EQ(forbidden.allocations(), 0);
  EXPECT_EQ(forbidden.releases(), 0);
}

TEST(StyleWalker, says_how_to_train_a_model_that_it_can_walk_with) {
  Model without = *model();
  without.style_space.reset();
  try {
    StyleWalker walker(std::make_shared<const Model>(without), 1);
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("train"), std::string::npos);
  }
}

}  // namespace
}  // namespace gait
