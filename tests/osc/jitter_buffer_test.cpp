// Frames that came unevenly leave evenly, no later than was asked.
#include "gait/osc/jitter_buffer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>

namespace gait::testing {
namespace {

struct Left {
  double at, value, waited;
};

// Frames at `rate`, each late by chance up to `most_late` seconds, some lost; asked every
// millisecond.
std::vector<Left> played(double delay, double rate, double most_late, double lost, int frames,
                         unsigned seed = 4) {
  osc::JitterBuffer buffer(1);
  buffer.set_delay(delay);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> chance;
  std::vector<std::pair<double, float>> arrivals;
  for (int i = 0; i < frames; ++i) {
    const double at = i / rate + most_late * chance(random);
    if (chance(random) >= lost)
      arrivals.emplace_back(std::max(at, arrivals.empty() ? 0 : arrivals.back().first + 1e-4),
                            static_cast<float>(i));
  }
  std::vector<Left> left;
  std::size_t next = 0;
  for (double now = 0; now < frames / rate + 1; now += 0.001) {
    while (next < arrivals.size() && arrivals[next].first <= now) {
      buffer.push(arrivals[next].first, std::span(&arrivals[next].second, 1));
      ++next;
    }
    for (auto frame = buffer.pop(now); !frame.empty(); frame = buffer.pop(now))
      left.push_back({now, frame[0], now - buffer.arrival()});
  }
  EXPECT_EQ(left.size(), arrivals.size());
  return left;
}

// Root mean square of how unevenly frames leave against their numbers, seconds, the first second
// apart.
double unevenness(const std::vector<Left>& left, double rate) {
  double mean = 0, squares = 0;
  int count = 0;
  for (const Left& frame : left)
    if (frame.value >= rate) mean += frame.at - frame.value / rate, ++count;
  mean /= count;
  for (const Left& frame : left)
    if (frame.value >= rate) squares += std::pow(frame.at - frame.value / rate - mean, 2);
  return std::sqrt(squares / count);
}

// Where frames are also lost, who is late and who is lost cannot be told apart at once.
TEST(JitterBuffer, evens_out_what_comes_unevenly_in_its_order) {
  for (const auto& [most_late, lost, share] :
       {std::tuple(0.02, 0.0, 0.5), {0.012, 0.0, 0.5}, {0.004, 0.0, 0.5}, {0.02, 0.01, 0.8}}) {
    double before = 0, after = 0;
    for (unsigned seed = 0; seed < 8; ++seed) {
      const auto even = played(0.04, 60, most_late, lost, 600, seed);
      before += unevenness(played(0, 60, most_late, lost, 600, seed), 60);
      after += unevenness(even, 60);
      for (std::size_t i = 1; i < even.size(); ++i) {
        EXPECT_GT(even[i].value, even[i - 1].value);
        EXPECT_LE(even[i].waited, 0.04 + 0.021);
      }
    }
    std::printf("to %.0f ms late, %.0f %% lost: %.2f ms uneven, %.2f after\n", 1000 * most_late,
                100 * lost, 1000 * before / 8, 1000 * after / 8);
    EXPECT_LT(after, share * before + 8 * 0.0003);
  }
}

TEST(JitterBuffer, without_delay_frames_leave_at_once) {
  for (const Left& frame : played(0, 60, 0.02, 0, 300)) EXPECT_LE(frame.waited, 0.0011);
}

// After a dropout a network hands over what it held back, all at once.
TEST(JitterBuffer, evens_out_again_after_a_burst) {
  osc::JitterBuffer buffer(1);
  buffer.set_delay(0.05);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> late(0, 0.015);
  double time = 0;
  for (int i = 0; i < 20; ++i) {
    const float value = static_cast<float>(i - 20);
    buffer.push(time += 6e-5, std::span(&value, 1));
  }
  std::vector<Left> left;
  std::vector<std::pair<double, float>> arrivals;
  for (int i = 0; i < 600; ++i) arrivals.emplace_back(0.1 + i / 60.0 + late(random), i);
  std::size_t next = 0;
  for (double now = 0; now < 11; now += 0.001) {
    for (; next < arrivals.size() && arrivals[next].first <= now; ++next)
      buffer.push(arrivals[next].first, std::span(&arrivals[next].second, 1));
    for (auto frame = buffer.pop(now); !frame.empty(); frame = buffer.pop(now))
      left.push_back({now, frame[0], 0});
  }
  EXPECT_EQ(left.size(), 620u);
  EXPECT_LT(unevenness(left, 60), 0.5 * 0.015 / std::sqrt(12));
}

TEST(JitterBuffer, a_long_delay_holds_nothing_back_for_ever) {
  for (const Left& frame : played(1, 120, 0.005, 0, 600)) EXPECT_LE(frame.waited, 1.01);
}

TEST(JitterBuffer, a_flood_pushes_the_oldest_out) {
  osc::JitterBuffer buffer(2);
  buffer.set_delay(10);
  for (int i = 0; i < 1000; ++i) {
    const float values[] = {static_cast<float>(i), 0};
    buffer.push(i * 1e-3, values);
  }
  EXPECT_EQ(buffer.waiting(), osc::JitterBuffer::most_frames);
  EXPECT_EQ(buffer.lost(), 1000 - osc::JitterBuffer::most_frames);
  EXPECT_TRUE(buffer.pop(1).empty());
  const auto oldest = buffer.pop(100);
  ASSERT_EQ(oldest.size(), 2u);
  EXPECT_EQ(oldest[0], 1000 - osc::JitterBuffer::most_frames);
  buffer.reset();
  EXPECT_TRUE(buffer.pop(1000).empty());
}

}  // namespace
}  // namespace gait::testing
