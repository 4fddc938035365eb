// What a frame of the step walker costs, and of a walk on stage that has lost its input.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>

#include "bench_model.h"
#include "gait/play/body/body_stage.h"
#include "gait/play/synthesise/step_walker.h"
#include "gait/play/synthesise/synthesiser.h"

namespace gait::bench {
namespace {

// Median and 99th percentile of single frames, microseconds.
template <typename Frame>
void frames(benchmark::State& state, Frame frame) {
  std::vector<double> times;
  times.reserve(1 << 22);
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    frame();
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    times.push_back(took.count());
  }
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) {
    return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))];
  };
  state.counters["p50_us"] = at(0.5);
  state.counters["p99_us"] = at(0.99);
}

void step_walker(benchmark::State& state) {
  StepWalker walker(bench_model(8));
  walker.set_style(1);
  frames(state, [&] {
    walker.advance();
    benchmark::DoNotOptimize(walker.pose().data());
  });
}

void walking_alone(benchmark::State& state) {
  Synthesiser synthesiser(bench_model(8));
  BodyStage stage(bench_model(8));
  frames(state, [&] {
    synthesiser.go_on();
    stage.show_pose(synthesiser.pose());
    benchmark::DoNotOptimize(stage.root());
  });
}

BENCHMARK(step_walker);
BENCHMARK(walking_alone);

}  // namespace
}  // namespace gait::bench
