#include "gait/play/recognise/live_recogniser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gait/play/input/sender_clock.h"
#include "gait/play/map/observation_message.h"
#include "play/cycles/styled_walks.h"
#include "play/few_walks.h"
#include "play/forbidden_memory.h"
#include "play/played_stream.h"

namespace gait {
namespace {

using testing::corpus_walks;
using testing::few_walks_model;
using testing::ForbiddenMemory;
using testing::frame_of;
using testing::held_out_inputs;

TEST(StyleChoice, changes_when_another_has_led_by_the_margin_for_the_hold) {
  StyleChoice choice(10);
  choice.set_margin(0.2f);
  choice.set_hold(0.3);
  EXPECT_EQ(choice.style(), -1);
  const std::vector<float> first{0.7f, 0.2f, 0.1f}, close{0.4f, 0.5f, 0.1f},
      second{0.2f, 0.7f, 0.1f};
  EXPECT_FALSE(choice.advance(first));
  EXPECT_FALSE(choice.advance(first));
  EXPECT_TRUE(choice.advance(first));
  EXPECT_EQ(choice.style(), 0);
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(choice.advance(close)) << "too little ahead";
  EXPECT_FALSE(choice.advance(second));
  EXPECT_FALSE(choice.advance(second));
  EXPECT_FALSE(choice.advance(first)) << "not in a row";
  EXPECT_FALSE(choice.advance(second));
  EXPECT_FALSE(choice.advance(second));
  EXPECT_TRUE(choice.advance(second));
  EXPECT_EQ(choice.style(), 1);
  choice.reset();
  EXPECT_EQ(choice.style(), -1);
  EXPECT_FALSE(choice.advance({}));
}

TEST(SenderClock, takes_arrivals_for_times_when_the_rate_is_not_known) {
  SenderClock clock;
  for (const double now : {1.0, 1.01, 1.7}) EXPECT_EQ(clock.time_of_arrival(now), now);
}

TEST(SenderClock, a_known_rate_takes_jitter_away_and_counts_lost_frames) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double drift : {1.0, 0.999}) {
    SenderClock clock;
    clock.set_rate(30);
    double before = 0, worst_step = 0, worst = 0, offset = 0;
    int frames = 0;
    for (int frame = 0; frame < 3000; ++frame) {
      if (uniform(random) > 0.9) continue;  // 5 % are lost
      const double taken = 5 + frame / 30.0 / drift;
      const double time = clock.time_of_arrival(taken + 0.02 * uniform(random));
      if (frames++ > 300) {
        if (offset == 0) offset = time - taken;
        worst = std::max(worst, std::abs(time - taken - offset));
        const double step = (time - before) * 30;  // periods
        worst_step = std::max(worst_step, std::abs(step - std::round(step)));
        EXPECT_GT(step, 0.9);
      }
      before = time;
    }
    // A lost frame may be noticed a frame or two later, nothing else is wrong.
    EXPECT_LT(worst, 0.05);
    EXPECT_LT(worst_step, 0.05);
  }
}

TEST(SenderClock, frames_that_come_all_at_once_are_a_period_apart) {
  SenderClock clock;
  clock.set_rate(60);
  for (int frame = 0; frame < 100; ++frame)
    EXPECT_NEAR(clock.time_of_arrival(3), 3 + frame / 60.0, 1e-9);
}

TEST(LiveRecogniser, knows_styles_and_stays_with_them_in_walks_it_has_not_seen) {
  const auto model = corpus_walks().model;
  for (const std::string& style : model->styles) {
    LiveRecogniser live(model);
    const CorpusWalk walk = make_walk(testing::plan_of(style, 77, 6));
    const Eigen::MatrixXf inputs = testing::streams_of(walk, *model->body).inputs.cast<float>();
    int changes = 0, chosen = -1, right = 0, frames = 0;
    for (int frame = 0; frame < inputs.cols(); ++frame) {
      live.stream().push(frame / 30.0, frame_of(inputs, frame));
      while (live.next()) {
        EXPECT_TRUE(live.walking());
        changes += live.style() != chosen;
        chosen = live.style();
        if (frame >= 60) ++frames, right += live.style() == testing::style_named(*model, style);
      }
    }
    EXPECT_LE(changes, 3) << style;
    EXPECT_GE(right, 0.9 * frames) << style;
  }
}

TEST(LiveRecogniser, decides_alike_whatever_the_senders_rate) {
  const auto model = corpus_walks().model;
  for (const std::string& style : model->styles) {
    std::vector<Decision> slow;
    for (const double rate : {30.0, 60.0, 120.0}) {
      const CorpusWalk walk = make_walk(testing::plan_of(style, 77, 6), rate);
      const auto poses = testing::input_poses(walk.clip, *model->body);
      LiveRecogniser live(model);
      std::vector<Decision> decisions;
      for (std::size_t i = 0; i < poses.size(); ++i) {
        for (std::size_t stream = 0; stream < poses[i].size(); ++stream)
          live.stream().set_rotation(static_cast<int>(stream), poses[i][stream]);
        live.stream().push_collected(static_cast<double>(i) / rate);
        while (live.next()) decisions.push_back(live.decision());
      }
      if (rate == 30) slow = decisions;
      const auto frames = std::min(slow.size(), decisions.size());
      ASSERT_GT(frames, 100u);
      std::size_t alike = 0;
      for (std::size_t i = 0; i < frames; ++i)
        alike += slow[i].label == decisions[i].label && slow[i].state == decisions[i].state;
      EXPECT_GE(static_cast<double>(alike), 0.98 * static_cast<double>(frames))
          << style << " at " << rate;
    }
  }
}

TEST(LiveRecogniser, says_how_unlike_everything_taught_a_motion_is) {
  EXPECT_EQ(unlikeness(0, 1.25f), 0);
  EXPECT_NEAR(unlikeness(1.25f, 1.25f), 0.5, 1e-6);
  EXPECT_EQ(unlikeness(1e30f, 1.25f), 1);
  const auto model = corpus_walks().model;
  std::vector<float> taught;
  for (const Walk& walk : corpus_walks().walks) {
    LiveRecogniser live(model);
    const BodyPoses poses = body_poses(
        walk.clip, *model->body, match_joints(*model->body, walk.clip.skeleton, walk.clip.name),
        model->body->heading_window);
    const Sequence sequence = walk_sequence(*model->body, poses, walk.contacts, walk.clip.name);
    const Eigen::MatrixXf inputs = sequence.inputs.cast<float>();
    for (int frame = 0; frame < inputs.cols(); ++frame) {
      live.stream().push(frame / 30.0, frame_of(inputs, frame));
      while (live.next())
        if (frame >= 10) taught.push_back(live.unlike());
    }
  }
  std::sort(taught.begin(), taught.end());
  EXPECT_LT(taught[taught.size() / 2], 0.2f);
  EXPECT_NEAR(taught[taught.size() * 98 / 100], 0.45, 0.15);
  // Arms that fly.
  LiveRecogniser live(model);
  std::vector<float> values(model->input.values);
  for (int frame = 0; frame < 60; ++frame) {
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = 0.5f * std::sin(0.3f * static_cast<float>(frame) + static_cast<float>(i));
    live.stream().push(frame / 30.0, values);
    while (live.next()) {
      if (frame < 10) continue;
      EXPECT_GT(live.unlike(), 0.95f);
    }
  }
}

TEST(LiveRecogniser, who_stops_has_a_phase_that_stands_and_goes_on_when_walking_on) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  LiveRecogniser live(model);
  double time = 0;
  const auto give = [&](int frame) {
    live.stream().push(time += 1 / 30.0, frame_of(inputs, frame));
    while (live.next()) {
    }
  };
  for (int frame = 0; frame < 80; ++frame) give(frame);
  EXPECT_TRUE(live.walking());
  for (int i = 0; i < 60; ++i) give(79);
  EXPECT_FALSE(live.walking());
  const float stood = live.decision().phase;
  for (int i = 0; i < 60; ++i) give(79);
  EXPECT_EQ(live.decision().phase, stood);
  EXPECT_EQ(live.decision().cadence, 0);
  for (int frame = 80; frame < 110; ++frame) give(frame);
  EXPECT_TRUE(live.walking());
  EXPECT_GT(live.decision().cadence, 0.5);
}

TEST(LiveRecogniser, begins_anew_after_a_silence) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  LiveRecogniser used(model, {}, 0.25), fresh(model, {}, 0.25);
  for (int frame = 0; frame < 50; ++frame) {
    used.stream().push(frame / 30.0, frame_of(inputs, frame));
    while (used.next()) EXPECT_EQ(used.first_of_run(), frame == 0);
  }
  for (int frame = 0; frame < 50; ++frame) {
    used.stream().push(100 + frame / 30.0, frame_of(inputs, frame));
    fresh.stream().push(frame / 30.0, frame_of(inputs, frame));
    while (used.next()) {
      ASSERT_TRUE(fresh.next());
      EXPECT_EQ(used.first_of_run(), frame == 0);
      EXPECT_EQ(used.decision().state, fresh.decision().state);
      EXPECT_NEAR(used.decision().phase, fresh.decision().phase, 1e-5);
      EXPECT_EQ(used.style(), fresh.style());
    }
  }
}

TEST(LiveRecogniser, takes_no_memory_while_it_plays) {
  if (!ForbiddenMemory::works()) GTEST_SKIP() << "a sanitizer has malloc";
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  LiveRecogniser live(model);
  ObservationMessage message(*model);
  std::size_t sent = 0;
  long allocations = 0, releases = 0;
  {
    const ForbiddenMemory forbidden;
    for (int frame = 0; frame < inputs.cols(); ++frame) {
      if (frame % 40 == 20) live.set_missing(1, frame % 80 == 20);
      live.stream().push(frame / 60.0, frame_of(inputs, frame));
      while (live.next()) sent += message.write(live.recogniser()).size();
    }
    live.reset();
    allocations = forbidden.allocations();
    releases = forbidden.releases();
  }
  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(releases, 0);
  EXPECT_GT(sent, 1000u);
}

}  // namespace
}  // namespace gait
