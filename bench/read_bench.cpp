// What reading a BVH file costs, beside reading its numbers alone.
#include <benchmark/benchmark.h>

#include <random>
#include <string>
#include <string_view>

#include "gait/files/bvh.h"
#include "gait/numbers.h"

namespace gait::bench {
namespace {

constexpr int joints = 60, frames = 7200;

// A minute of 60 joints at 120 frames a second.
const std::string& minute() {
  static const std::string text = [] {
    std::string made = "HIERARCHY\n";
    for (int joint = 0; joint < joints; ++joint)
      made += (joint == 0 ? "ROOT" : "JOINT") + std::string(" J") + std::to_string(joint) +
              " { OFFSET 0 1 0 CHANNELS 3 Zrotation Xrotation Yrotation\n";
    made += std::string(joints, '}') + "\nMOTION\nFrames: " + std::to_string(frames) +
            "\nFrame Time: 0.0083333\n";
    std::mt19937 random(3);
    std::uniform_real_distribution<double> angle(-180, 180);
    for (int row = 0; row < frames; ++row) {
      for (int value = 0; value < 3 * joints; ++value) made += std::to_string(angle(random)) + ' ';
      made += '\n';
    }
    return made;
  }();
  return text;
}

void read_a_minute(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(parse_bvh(minute(), "minute").values.data());
}
BENCHMARK(read_a_minute)->Unit(benchmark::kMillisecond);

// The floor: no way of reading does without these.
void its_numbers_alone(benchmark::State& state) {
  const std::string_view text = minute();
  const std::string_view motion = text.substr(text.find("0.0083333") + 9);
  for (auto _ : state) {
    double sum = 0;
    for (std::size_t at = 0; at < motion.size();) {
      const LeadingNumber number = leading_number(motion.substr(at));
      sum += number.value;
      at += number.length + 1;
    }
    benchmark::DoNotOptimize(sum);
  }
}
BENCHMARK(its_numbers_alone)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gait::bench
