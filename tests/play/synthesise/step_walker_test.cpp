// The step walker as a player meets it: labels, durations, styles, streams.
#include "gait/play/synthesise/step_walker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "gait/error.h"
#include "gait/model/model_file.h"
#include "model/small_model.h"
#include "play/change/joint_motion.h"
#include "play/cycles/styled_walks.h"
#include "play/few_walks.h"
#include "play/forbidden_memory.h"

namespace gait {
namespace {

using testing::corpus_walks;
using testing::ForbiddenMemory;
using testing::style_named;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr int right = 0, left = 1;

StepWalker corpus_walker() { return StepWalker(corpus_walks().model); }

// Frames from one label's begin to the next's, over `frames` frames.
std::vector<int> lengths(StepWalker& walker, int frames) {
  std::vector<int> lengths;
  int since = -1;
  for (int frame = 0; frame < frames; ++frame) {
    walker.advance();
    if (walker.entered()) {
      if (since >= 0) lengths.push_back(frame - since);
      since = frame;
    }
  }
  return lengths;
}

double mean_seconds(StepWalker& walker, int frames = 600) {
  walker.advance();
  for (int i = 0; i < 60; ++i) walker.advance();  // until what was set has arrived
  const std::vector<int> all = lengths(walker, frames);
  double sum = 0;
  for (const int length : all) sum += length;
  return sum / static_cast<double>(all.size()) / 30;
}

void expect_same_frames(StepWalker& a, StepWalker& b, int frames) {
  for (int frame = 0; frame < frames; ++frame) {
    a.advance(), b.advance();
    ASSERT_TRUE(std::ranges::equal(a.inputs(), b.inputs())) << "frame " << frame;
    ASSERT_TRUE(std::ranges::equal(a.outputs(), b.outputs())) << "frame " << frame;
    ASSERT_EQ(a.phase(), b.phase());
  }
}

TEST(StepWalker, takes_steps_as_long_as_its_style_does) {
  const Model& model = *corpus_walks().model;
  for (const char* style : {"sad", "in-a-hurry"}) {
    StepWalker walker = corpus_walker();
    ASSERT_TRUE(walker.set_style(style_named(model, style)));
    double sum = 0;
    int count = 0;
    for (const Walk& walk : corpus_walks().walks)
      if (walk.style == style)
        for (const Step& step : steps_between(walk.contacts))
          sum += (step.end - step.begin) / walk.clip.frame_rate, ++count;
    EXPECT_NEAR(mean_seconds(walker), sum / count, 0.02) << style;
  }
}

TEST(StepWalker, durations_are_scaled_shifted_fixed_and_at_a_cadence) {
  StepWalker plain = corpus_walker();
  const double own = mean_seconds(plain);
  const auto with = [&](const std::function<bool(LabelDurations&)>& set) {
    StepWalker walker = corpus_walker();
    EXPECT_TRUE(set(walker.durations()));
    return mean_seconds(walker);
  };
  // A frame in twenty steps and what a mean of whole frames leaves over.
  const double close = 0.01;
  EXPECT_NEAR(with([](LabelDurations& d) { return d.set_scale(1.5f); }), 1.5 * own, close);
  EXPECT_NEAR(with([](LabelDurations& d) { return d.set_shift(0.2f); }), own + 0.2, close);
  EXPECT_NEAR(with([](LabelDurations& d) { return d.fix(0.8f); }), 0.8, close);
  EXPECT_NEAR(with([](LabelDurations& d) { return d.set_cadence(2.5f); }), 0.4, close);
  EXPECT_NEAR(with([](LabelDurations& d) { return d.fix(0.8f) && d.fix(0); }), own, close);
  EXPECT_NEAR(with([](LabelDurations& d) { return d.fix(0.4f, right) && d.fix(0.8f, left); }), 0.6,
              close);
}

TEST(StepWalker, limps_when_one_foot_lasts_longer) {
  StepWalker walker = corpus_walker();
  walker.durations().fix(0.4f, right);
  walker.durations().fix(0.8f, left);
  walker.advance();
  EXPECT_EQ(walker.entered(), right);
  for (const int length : lengths(walker, 200))
    EXPECT_TRUE(std::abs(length - 12) <= 1 || std::abs(length - 24) <= 1) << length;
}

TEST(StepWalker, takes_the_steps_it_is_told_and_then_stands) {
  StepWalker walker = corpus_walker();
  walker.set_auto(false);
  for (const int label : {left, right, left}) EXPECT_TRUE(walker.queue(label));
  EXPECT_EQ(walker.queued(), 3);
  std::vector<int> taken;
  for (int frame = 0; frame < 120; ++frame) {
    walker.advance();
    if (walker.entered()) taken.push_back(*walker.entered());
  }
  EXPECT_EQ(taken, (std::vector<int>{left, right, left}));
  EXPECT_EQ(walker.queued(), 0);
  EXPECT_EQ(walker.cadence(), 0);
  EXPECT_EQ(walker.progress(), 1);
  const std::vector<float> stood(walker.outputs().begin(), walker.outputs().end());
  walker.advance();
  for (std::size_t i = 0; i < stood.size(); ++i) EXPECT_NEAR(walker.outputs()[i], stood[i], 1e-4);
  EXPECT_TRUE(walker.queue(right));  // and goes on
  walker.set_auto(true);
  EXPECT_FALSE(lengths(walker, 90).empty());
}

TEST(StepWalker, never_takes_two_steps_with_one_foot) {
  StepWalker walker = corpus_walker();
  walker.set_auto(false);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(walker.queue(right));
  std::vector<int> taken;
  for (int frame = 0; frame < 150; ++frame) {
    walker.advance();
    if (walker.entered()) taken.push_back(*walker.entered());
  }
  EXPECT_EQ(taken, (std::vector<int>{right, left, right, left, right}));
}

TEST(StepWalker, refuses_labels_that_are_not_there_and_more_than_its_queue_holds) {
  StepWalker walker = corpus_walker();
  EXPECT_FALSE(walker.queue(-1));
  EXPECT_FALSE(walker.queue(2));
  for (int i = 0; i < LabelQueue::capacity; ++i) EXPECT_TRUE(walker.queue(i % 2));
  EXPECT_FALSE(walker.queue(right));
  walker.reset();
  EXPECT_EQ(walker.queued(), 0);
}

TEST(StepWalker, what_is_not_a_number_changes_nothing) {
  StepWalker told = corpus_walker(), untold = corpus_walker();
  const auto bad = [&] {
    for (const float value : {nan, infinite, -infinite}) {
      std::vector<float> weights(corpus_walks().model->styles.size(), 1.0f);
      weights[3] = value;
      EXPECT_FALSE(told.set_weights(weights));
      EXPECT_FALSE(told.durations().set_scale(value));
      EXPECT_FALSE(told.durations().set_shift(value));
      EXPECT_FALSE(told.durations().fix(value));
      EXPECT_FALSE(told.durations().set_cadence(value));
      EXPECT_FALSE(told.streams().set_scale(2, value));
      const float xyz[] = {0, value, 0};
      EXPECT_FALSE(told.streams().set_shift(2, xyz));
      EXPECT_FALSE(told.streams().fix(2, xyz));
    }
    const float one[] = {1};
    EXPECT_FALSE(told.streams().fix(2, one));
    EXPECT_FALSE(told.streams().set_scale(99, 1));
    EXPECT_FALSE(told.streams().free(-1));
    EXPECT_FALSE(told.set_style(99));
    EXPECT_FALSE(told.durations().fix(1, 2));
  };
  bad();
  expect_same_frames(told, untold, 20);
  bad();
  expect_same_frames(told, untold, 60);
}

TEST(StepWalker, a_joint_is_fixed_shifted_scaled_and_freed) {
  const Model& model = *corpus_walks().model;
  StepWalker walker = corpus_walker(), plain = corpus_walker();
  const int joint = body_roles(*model.body).left.shank;
  const int stream = walker.stream_of(joint);
  ASSERT_GE(stream, static_cast<int>(model.inputs.size()));
  const auto at = static_cast<std::size_t>(3 * (stream - static_cast<int>(model.inputs.size())));
  const auto advance = [&](int frames) {
    for (int i = 0; i < frames; ++i) walker.advance(), plain.advance();
  };
  advance(30);
  const float place[] = {0.3f, 0, -0.1f};
  EXPECT_TRUE(walker.streams().fix(stream, place));
  advance(40);  // arrived
  for (int i = 0; i < 30; ++i) {
    advance(1);
    EXPECT_NEAR(walker.outputs()[at], place[0], 1e-3);
    EXPECT_NEAR(walker.outputs()[at + 2], place[2], 1e-3);
  }
  EXPECT_TRUE(walker.streams().free(stream));
  EXPECT_TRUE(walker.streams().set_shift(stream, place));
  advance(40);
  EXPECT_NEAR(walker.outputs()[at] - plain.outputs()[at], place[0], 1e-3);
  EXPECT_TRUE(walker.streams().free(stream));
  EXPECT_TRUE(walker.streams().set_scale(stream, 2));
  advance(40);
  double mean = 0, plain_mean = 0, swing = 0, plain_swing = 0;
  constexpr int frames = 330;  // whole cycles, about
  std::vector<float> ours, theirs;
  for (int i = 0; i < frames; ++i) {
    advance(1);
    ours.push_back(walker.outputs()[at]), theirs.push_back(plain.outputs()[at]);
    mean += ours.back() / frames, plain_mean += theirs.back() / frames;
  }
  for (int i = 0; i < frames; ++i) {
    swing += std::pow(ours[i] - mean, 2), plain_swing += std::pow(theirs[i] - plain_mean, 2);
  }
  EXPECT_NEAR(std::sqrt(swing / plain_swing), 2, 0.01);
  EXPECT_NEAR(mean, plain_mean, 0.03);  // about the mean pose, radians
  EXPECT_TRUE(walker.streams().free(stream));
  // A joint that does not move by itself is moved all the same, and does not run away.
  EXPECT_TRUE(
      walker.streams().set_shift(walker.stream_of(body_roles(*model.body).right.foot), place));
  advance(60);
  EXPECT_TRUE(walker.streams().free(walker.stream_of(body_roles(*model.body).right.foot)));
  advance(60);
  for (std::size_t i = 0; i < walker.outputs().size(); ++i)
    EXPECT_NEAR(walker.outputs()[i], plain.outputs()[i], 1e-4);
}

TEST(StepWalker, a_change_of_style_takes_about_a_step_and_never_jumps) {
  const Model& model = *corpus_walks().model;
  testing::JointMotion steady, changing;
  for (std::size_t a = 0; a < model.styles.size(); ++a) {
    StepWalker walker = corpus_walker();
    walker.set_style(static_cast<int>(a));
    std::vector<testing::Pose> poses;
    for (int frame = 0; frame < 160; ++frame) {
      if (frame == 100) walker.set_style(static_cast<int>((a + 5) % model.styles.size()));
      walker.advance();
      poses.emplace_back();
      for (const auto& rotation : walker.pose()) poses.back().push_back(rotation.cast<double>());
      if (frame == 136) {  // 1.2 s: a step of the slowest and the lookahead
        EXPECT_GT(walker.weights()[static_cast<Eigen::Index>((a + 5) % model.styles.size())], 0.9f);
      }
    }
    steady.add(poses, 30, 5, 100);
    changing.add(poses, 30, 100, 140);
  }
  EXPECT_LE(testing::percentile(changing.speeds, 0.999),
            1.1 * testing::percentile(steady.speeds, 0.999));
  EXPECT_LE(testing::percentile(changing.accelerations, 0.999),
            1.1 * testing::percentile(steady.accelerations, 0.999));
}

TEST(StepWalker, a_model_read_from_its_file_walks_the_same_to_the_bit) {
  const auto read =
      std::make_shared<const Model>(parse_model(model_bytes(*corpus_walks().model), "m"));
  StepWalker walker = corpus_walker(), again(read);
  walker.set_style(2), again.set_style(2);
  expect_same_frames(walker, again, 200);
}

TEST(StepWalker, walks_on_when_the_model_changes) {
  const auto other = std::make_shared<Model>(*corpus_walks().model);
  for (Label& label : other->labels)
    for (State& state : label.states) state.trajectory_means *= 1.02;
  StepWalker before = corpus_walker(), after(PlayModel{other});
  before.set_style(4);
  for (int i = 0; i < 50; ++i) before.advance();
  before.queue(left);
  ASSERT_TRUE(after.take_over(before));
  EXPECT_EQ(after.queued(), before.queued());
  EXPECT_EQ(after.phase(), before.phase());
  std::vector<testing::Pose> poses;
  float phase = after.phase();
  for (int i = 0; i < 30; ++i) {
    after.advance();
    const float moved = after.phase() - phase;
    EXPECT_LT(moved - std::floor(moved), 0.06f);  // cycles a frame
    phase = after.phase();
    poses.emplace_back();
    for (const auto& rotation : after.pose()) poses.back().push_back(rotation.cast<double>());
  }
  testing::JointMotion motion;
  motion.add(poses, 30, 0, 30);
  EXPECT_LT(testing::percentile(motion.accelerations, 1), 252);  // rad/s², as in training
  StepWalker small(testing::few_walks_model());
  EXPECT_FALSE(small.take_over(before));
}

TEST(StepWalker, gestures_without_a_body_walk_too) {
  Model model = testing::learnt_model();
  model.body.reset();
  StepWalker walker(std::make_shared<const Model>(model));
  float least = 10, most = -10;
  for (int i = 0; i < 90; ++i) {
    walker.advance();
    least = std::min(least, walker.outputs()[3]), most = std::max(most, walker.outputs()[3]);
    EXPECT_NEAR(walker.inputs()[4], 0.25f, 1e-3);  // never moved in training
  }
  EXPECT_TRUE(walker.pose().empty());
  EXPECT_GT(most - least, 0.6f);  // sinusoids of 0.4 and more
}

TEST(StepWalker, a_model_learnt_without_trajectories_says_so) {
  Model model = testing::large_model();
  try {
    StepWalker walker(std::make_shared<const Model>(model));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("train it again"), std::string::npos) << error.what();
  }
}

TEST(StepWalker, takes_no_memory) {
  if (!ForbiddenMemory::works()) GTEST_SKIP() << "a sanitizer has malloc";
  StepWalker walker = corpus_walker(), other = corpus_walker();
  const float place[] = {0.1f, 0, 0};
  long allocations = 0, releases = 0;
  {
    const ForbiddenMemory forbidden;
    for (int i = 0; i < 200; ++i) {
      if (i % 20 == 0) walker.set_style(i / 20);
      if (i == 30) walker.queue(left);
      if (i == 40) walker.streams().fix(3, place);
      if (i == 50) walker.durations().set_cadence(1.5f);
      if (i == 60) other.take_over(walker);
      if (i == 100) walker.enter({left, 0.3f, 1.9f}, {});
      if (i == 150) walker.reset();
      walker.advance();
    }
    allocations = forbidden.allocations(), releases = forbidden.releases();
  }
  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(releases, 0);
}

}  // namespace
}  // namespace gait
