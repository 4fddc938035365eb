#include "gait/play/input/frame_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "gait/error.h"
#include "gait/motion/rotation.h"

namespace gait {
namespace {

struct Frame {
  double time;
  Eigen::Quaternionf rotation;
  float plain;
  bool first;
};

// A joint that swings at 1 Hz by 0.5 rad about an axis that turns, and a plain value with it.
Eigen::Quaternionf swinging(double t) {
  const Eigen::Vector3d axis = Eigen::Vector3d(std::cos(t), 1, std::sin(t)).normalized();
  return exponential_map<double>(axis * (0.5 * std::sin(2 * M_PI * t))).cast<float>();
}
float humming(double t) { return static_cast<float>(std::cos(2 * M_PI * t)); }

class Stream {
 public:
  explicit Stream(double rate) : clock_(rate, 1, 1) {}

  FrameClock::Arrival push(double time, double truth) {
    const Eigen::Quaternionf rotation = swinging(truth);
    const float plain = humming(truth);
    const auto arrival = clock_.push(time, {&rotation, 1}, {&plain, 1});
    Frame frame;
    while (clock_.next({&frame.rotation, 1}, {&frame.plain, 1})) {
      frame.time = clock_.time();
      frame.first = clock_.first_of_run();
      frames.push_back(frame);
    }
    return arrival;
  }
  FrameClock::Arrival push(double time) { return push(time, time); }

  std::vector<Frame> frames;

 private:
  FrameClock clock_;
};

TEST(FrameClock, thirty_sixty_and_a_hundred_and_twenty_fps_give_the_same_frames) {
  Stream reference(30);
  for (int i = 0; i <= 300; ++i) reference.push(i / 30.0);
  ASSERT_EQ(reference.frames.size(), 301u);
  for (const int rate : {60, 120, 240}) {
    Stream stream(30);
    for (int i = 0; i <= 10 * rate; ++i) stream.push(i / static_cast<double>(rate));
    ASSERT_EQ(stream.frames.size(), 301u) << rate << " fps";
    for (std::size_t k = 0; k < 301; ++k) {
      EXPECT_NEAR(stream.frames[k].time, reference.frames[k].time, 1e-9);
      EXPECT_LT(angle_between(stream.frames[k].rotation, reference.frames[k].rotation), 1e-6f);
      EXPECT_NEAR(stream.frames[k].plain, reference.frames[k].plain, 1e-6f);
    }
  }
}

TEST(FrameClock, a_sender_at_the_models_rate_passes_one_for_one_however_its_times_are_rounded) {
  const auto whole_ms = [](int i) { return std::round(i * 1000 / 30.0) / 1000; };
  const auto six_digits = [](int i) { return i * 0.0333333; };
  const auto five_digits = [](int i) { return i * 0.03333; };
  const auto ntsc = [](int i) { return i * 1.001 / 30; };
  const auto since_1970 = [](int i) { return 1.7e9 + i / 30.0; };
  const auto in_float = [](int i) { return static_cast<double>(static_cast<float>(i / 30.0)); };
  const std::vector<double (*)(int)> senders{whole_ms, six_digits, five_digits,
                                             ntsc,     since_1970, in_float};
  for (std::size_t which = 0; which < senders.size(); ++which)
    for (const double rate : {30.0, 1 / 0.0333333}) {
      Stream stream(rate);
      for (int i = 0; i < 5000; ++i) {  // three minutes
        stream.push(senders[which](i), i / 30.0);
        ASSERT_EQ(stream.frames.size(), i + 1u) << "sender " << which << ", frame " << i;
        ASSERT_EQ(stream.frames.back().rotation.coeffs(), swinging(i / 30.0).coeffs())
            << "sender " << which << ", frame " << i;
        ASSERT_EQ(stream.frames.back().first, i == 0);
      }
    }
}

TEST(FrameClock, frames_between_poses_lie_on_the_motion) {
  // 100 and 75 fps never fall on ticks: SLERP cuts the corner by a" T^2/8, here at most 2.5e-3.
  for (const int rate : {75, 100}) {
    Stream stream(30);
    for (int i = 0; i <= 10 * rate; ++i) stream.push(3.7 + i / static_cast<double>(rate));
    ASSERT_EQ(stream.frames.size(), 301u);
    for (std::size_t k = 0; k < stream.frames.size(); ++k) {
      const double tick = 3.7 + static_cast<double>(k) / 30;
      EXPECT_NEAR(stream.frames[k].time, tick, 1e-9);
      EXPECT_LT(angle_between(stream.frames[k].rotation, swinging(tick)), 2.5e-3f);
      EXPECT_NEAR(stream.frames[k].plain, humming(tick), 5e-3f);
    }
  }
}

TEST(FrameClock, a_slower_sender_is_filled_in_and_nothing_is_late_by_more_than_its_own_period) {
  Stream stream(30);
  for (int i = 0; i <= 240; ++i) {
    const double now = i / 24.0;
    stream.push(now);
    ASSERT_FALSE(stream.frames.empty());
    EXPECT_GT(stream.frames.back().time, now - 1 / 30.0 - 1e-9);
  }
  EXPECT_EQ(stream.frames.size(), 301u);
}

TEST(FrameClock, jittered_times_give_steady_ticks) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> jitter(-0.006, 0.006);
  for (const double rate : {60.0, 120.0}) {
    Stream stream(30);
    double time = 0, last = -1;
    for (int i = 0; i <= 10 * rate; ++i) {
      time = i / rate + (i ? jitter(random) : 0);
      if (time <= last) continue;
      last = time;
      stream.push(time);
    }
    EXPECT_NEAR(static_cast<double>(stream.frames.size()), 301, 1);
    for (std::size_t k = 1; k < stream.frames.size(); ++k) {
      // The pull of poses near a tick moves it by at most 55 us.
      EXPECT_NEAR(stream.frames[k].time - stream.frames[k - 1].time, 1 / 30.0, 6e-5);
      // Corner cutting over up to 45 ms, and up to 0.55 ms beside the tick at 3.3 rad/s.
      EXPECT_LT(angle_between(stream.frames[k].rotation, swinging(stream.frames[k].time)), 9e-3f);
    }
  }
}

// Live, at the model's rate: times of arrival tremble by the network and by who looks for them once
// a millisecond. Waiting for the pose after a tick would be a whole frame of delay.
TEST(FrameClock, a_pose_that_arrives_a_little_early_does_not_wait_for_the_next) {
  std::mt19937 random(9);
  for (const double most : {0.0015, 0.004, 0.008}) {
    std::uniform_real_distribution<double> delay(0, most);
    for (int start = 0; start < 20; ++start) {  // the first one may be the latest of all
      Stream stream(30);
      std::size_t before = 0;
      for (int i = 0; i < 600; ++i) {
        stream.push(i * 1.003 / 30 + delay(random), i / 30.0);  // a sender's clock is a little off
        if (i >= 30) {
          ASSERT_EQ(stream.frames.size(), before + 1) << most << " " << i;
          ASSERT_EQ(stream.frames.back().rotation.coeffs(), swinging(i / 30.0).coeffs());
        }
        before = stream.frames.size();
      }
      for (std::size_t k = 60; k < stream.frames.size(); ++k)
        EXPECT_NEAR(stream.frames[k].time - stream.frames[k - 1].time, 1 / 30.0, 0.1 * most + 2e-4);
    }
  }
}

// After a dropout a network hands over what it held back, all at once.
TEST(FrameClock, a_burst_at_the_beginning_is_forgotten_within_two_seconds) {
  std::mt19937 random(10);
  std::uniform_real_distribution<double> delay(0, 0.003);
  Stream stream(30);
  for (int i = 0; i < 12; ++i) stream.push(0.001 * i, i / 30.0);
  std::size_t before = 0;
  for (int i = 1; i < 300; ++i) {
    stream.push(0.02 + i / 30.0 + delay(random), 0.4 + i / 30.0);
    if (i > 60) {
      ASSERT_EQ(stream.frames.size(), before + 1) << i;
    }
    before = stream.frames.size();
  }
}

TEST(FrameClock, a_sender_that_changes_to_another_rate_is_resampled_again) {
  Stream stream(30);
  for (int i = 0; i < 60; ++i) stream.push(i / 30.0);
  for (int i = 1; i <= 600; ++i) stream.push(2 + i / 100.0);
  ASSERT_NEAR(static_cast<double>(stream.frames.size()), 240, 2);
  for (std::size_t k = 150; k < stream.frames.size(); ++k) {
    EXPECT_NEAR(stream.frames[k].time - stream.frames[k - 1].time, 1 / 30.0, 6e-5);
    EXPECT_LT(angle_between(stream.frames[k].rotation, swinging(stream.frames[k].time)), 2.5e-3f);
  }
}

TEST(FrameClock, a_gap_restarts_the_clock_instead_of_inventing_frames) {
  Stream stream(30);
  for (int i = 0; i <= 30; ++i) stream.push(i / 30.0);
  ASSERT_EQ(stream.frames.size(), 31u);
  EXPECT_EQ(stream.push(101.01), FrameClock::Arrival::restarted);
  ASSERT_EQ(stream.frames.size(), 32u);
  EXPECT_TRUE(stream.frames.back().first);
  EXPECT_EQ(stream.frames.back().time, 101.01);
  EXPECT_EQ(stream.push(101.01 + 1 / 30.0), FrameClock::Arrival::accepted);
  EXPECT_FALSE(stream.frames.back().first);
  // Back to the start, as when a player loops.
  EXPECT_EQ(stream.push(0.0), FrameClock::Arrival::restarted);
  EXPECT_TRUE(stream.frames.back().first);
  EXPECT_EQ(stream.frames.size(), 34u);
}

TEST(FrameClock, a_short_hole_is_bridged) {
  Stream stream(30);
  stream.push(0.0);
  EXPECT_EQ(stream.push(0.2), FrameClock::Arrival::accepted);
  ASSERT_EQ(stream.frames.size(), 7u);
  for (int k = 0; k < 7; ++k) EXPECT_NEAR(stream.frames[k].time, k / 30.0, 1e-4);
}

TEST(FrameClock, bad_times_and_poses_change_nothing) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Stream good(30), bad(30);
  for (int i = 0; i <= 90; ++i) {
    const double time = i / 45.0;
    good.push(time);
    bad.push(time);
    EXPECT_EQ(bad.push(time, 0.3), FrameClock::Arrival::rejected);
    EXPECT_EQ(bad.push(time - 0.01, 0.3), FrameClock::Arrival::rejected);
    EXPECT_EQ(bad.push(nan, 0.3), FrameClock::Arrival::rejected);
    EXPECT_EQ(bad.push(INFINITY, 0.3), FrameClock::Arrival::rejected);
    EXPECT_EQ(bad.push(time + 0.01, nan), FrameClock::Arrival::rejected);
  }
  ASSERT_EQ(good.frames.size(), bad.frames.size());
  for (std::size_t k = 0; k < good.frames.size(); ++k)
    EXPECT_EQ(good.frames[k].rotation.coeffs(), bad.frames[k].rotation.coeffs());
}

TEST(FrameClock, poses_of_another_size_are_rejected) {
  FrameClock clock(30, 2, 0);
  const std::vector<Eigen::Quaternionf> three(3, Eigen::Quaternionf::Identity());
  std::vector<Eigen::Quaternionf> out(3);
  EXPECT_EQ(clock.push(0, three), FrameClock::Arrival::rejected);
  EXPECT_EQ(clock.push(0, std::span(three).first(2)), FrameClock::Arrival::restarted);
  EXPECT_FALSE(clock.next(out));
  EXPECT_TRUE(clock.next(std::span(out).first(2)));
  EXPECT_FALSE(clock.next(std::span(out).first(2)));
}

TEST(FrameClock, frames_nobody_pulls_are_lost_and_the_clock_goes_on) {
  FrameClock clock(30, 0, 1);
  float value = 0;
  for (int i = 0; i <= 10; ++i) {
    value = static_cast<float>(i);
    clock.push(i / 30.0, {}, {&value, 1});
  }
  ASSERT_TRUE(clock.next({}, {&value, 1}));
  EXPECT_EQ(value, 10);
  EXPECT_TRUE(clock.first_of_run());
  EXPECT_FALSE(clock.next({}, {&value, 1}));
}

TEST(FrameClock, a_rate_or_size_that_is_none_is_an_error) {
  EXPECT_THROW(FrameClock(0, 1), Error);
  EXPECT_THROW(FrameClock(-30, 1), Error);
  EXPECT_THROW(FrameClock(std::numeric_limits<double>::quiet_NaN(), 1), Error);
  EXPECT_THROW(FrameClock(30, -1), Error);
  EXPECT_THROW(FrameClock(30, 1, 0, 0.0), Error);
}

}  // namespace
}  // namespace gait
