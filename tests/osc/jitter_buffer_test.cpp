// Frames that came unevenly leave evenly, no later than was asked.
#include "gait/osc/jitter_buffer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
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

// Each second the network hands over nothing for `held` seconds, and then all that it held back.
// Share of the intervals, after the first two seconds, that are within 3 ms of the sender's.
double even_share(double held, double delay, double rate, bool clocked, unsigned seed) {
  osc::JitterBuffer buffer(1);
  buffer.set_delay(delay);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> late(0, 0.004);
  struct Arrival {
    double time, sent;
  };
  std::vector<Arrival> arrivals;
  const int frames = static_cast<int>(12 * rate);
  for (int i = 0; i < frames; ++i) {
    const double sent = i / rate;
    double time = sent + late(random);
    const double in_second = std::fmod(time, 1.0);
    if (in_second > 1 - held) time += 1 - in_second;
    arrivals.push_back({std::max(time, arrivals.empty() ? 0 : arrivals.back().time + 2e-5), sent});
  }
  std::vector<double> left;
  std::size_t next = 0;
  for (double now = 0; now < 13; now += 0.001) {
    for (; next < arrivals.size() && arrivals[next].time <= now; ++next) {
      const float value = static_cast<float>(next);
      buffer.push(arrivals[next].time, std::span(&value, 1),
                  clocked ? 4711 + arrivals[next].sent : osc::not_sent);
    }
    // One at a time, as [gait.osc] asks.
    if (const auto frame = buffer.pop(now); !frame.empty()) {
      EXPECT_EQ(frame[0], static_cast<float>(left.size()));
      left.push_back(now);
    }
  }
  EXPECT_EQ(left.size(), arrivals.size());
  int even = 0, all = 0;
  for (std::size_t i = static_cast<std::size_t>(2 * rate); i + 1 < left.size(); ++i, ++all)
    even += std::abs(left[i + 1] - left[i] - 1 / rate) <= 0.003 ? 1 : 0;
  return static_cast<double>(even) / all;
}

TEST(JitterBuffer, silences_as_long_as_the_delay_leave_no_gap) {
  for (const bool clocked : {true, false})
    for (const double rate : {30.0, 60.0, 120.0})
      for (const double held : {0.12, 0.2, 0.3}) {
        double least = 1;
        for (unsigned seed = 0; seed < 8; ++seed)
          least = std::min(least, even_share(held, held, rate, clocked, seed));
        std::printf("%s, %.0f fps, %.0f ms held each second: %.1f %% within 3 ms\n",
                    clocked ? "clock" : "no clock", rate, 1000 * held, 100 * least);
        EXPECT_GE(least, 0.95) << clocked << " " << rate << " " << held;
      }
}

// A clock that stands still, jumps, goes at another speed or in thousandths.
TEST(JitterBuffer, a_clock_is_used_only_while_it_goes_as_time_does) {
  const auto uneven_by = [](const std::function<double(int, double)>& clock) {
    osc::JitterBuffer buffer(1);
    buffer.set_delay(0.05);
    std::mt19937 random(6);
    std::uniform_real_distribution<double> late(0, 0.03);
    std::vector<double> arrivals;
    for (int i = 0; i < 600; ++i)
      arrivals.push_back(std::max(i / 60.0 + late(random), i ? arrivals.back() + 1e-4 : 0));
    std::vector<Left> left;
    std::size_t next = 0;
    for (double now = 0; now < 11; now += 0.001) {
      for (; next < arrivals.size() && arrivals[next] <= now; ++next) {
        const float value = static_cast<float>(next);
        buffer.push(arrivals[next], std::span(&value, 1),
                    clock(static_cast<int>(next), static_cast<double>(next) / 60));
      }
      for (auto frame = buffer.pop(now); !frame.empty(); frame = buffer.pop(now))
        left.push_back({now, frame[0], now - buffer.arrival()});
    }
    EXPECT_EQ(left.size(), 600u);
    for (const Left& frame : left) EXPECT_LE(frame.waited, 0.0521);
    return unevenness(left, 60);
  };
  const double counted = uneven_by([](int, double) { return osc::not_sent; });
  const double good = uneven_by([](int, double t) { return t; });
  EXPECT_LT(good, 0.0006);
  EXPECT_LT(uneven_by([](int, double t) { return 1000 * t; }), 0.0006);
  EXPECT_LT(uneven_by([](int, double t) { return std::floor(1000 * t) / 1000; }), 0.001);
  EXPECT_NEAR(uneven_by([](int, double) { return 0.0; }), counted, 1e-9);
  EXPECT_NEAR(uneven_by([](int, double t) { return t / 3; }), counted, 5e-4);
  EXPECT_NEAR(uneven_by([](int i, double) { return i % 2 * 7.0; }), counted, 1e-9);
  EXPECT_LT(uneven_by([](int i, double t) { return i < 300 ? t : t - 4; }), 0.003);  // restarts
  std::printf("%.2f ms uneven by a clock, %.2f by counting\n", 1000 * good, 1000 * counted);
  EXPECT_LT(counted, 0.004);
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
