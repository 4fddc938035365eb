// What one frame costs, beside the arithmetic that no way of doing it can avoid.
//
// Each benchmark times single frames and reports their median, 99th percentile and largest in
// microseconds, as a performer meets them.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "bench_model.h"
#include "gait/play/recognise/state_tables.h"
#include "gait/play/recognise/triangular.h"
#include "gait/play/stream_reconstructor.h"
#include "gait/play/synthesise/trajectory.h"

namespace gait::bench {
namespace {

constexpr int past = whole_past;

class FrameTimes {
 public:
  FrameTimes() { times_.reserve(1 << 22); }
  template <typename Work>
  void time(Work work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    times_.push_back(took.count());
  }
  void report(benchmark::State& state) {
    std::sort(times_.begin(), times_.end());
    const auto at = [&](double share) {
      return times_[static_cast<std::size_t>(share * static_cast<double>(times_.size() - 1))];
    };
    state.counters["p50_us"] = at(0.5);
    state.counters["p99_us"] = at(0.99);
    state.counters["max_us"] = times_.back();
  }

 private:
  std::vector<double> times_;
};

// Observe, decode, recognise the style, map, synthesise, move the root.
void whole_frame(benchmark::State& state, int states, DecoderKind decoder) {
  const auto model = bench_model(states);
  PlaySettings settings;
  settings.decoder = decoder;
  StreamReconstructor reconstructor(model, settings);
  const auto inputs = bench_inputs(*model, 300);
  FrameTimes times;
  std::size_t frame = 0;
  for (auto _ : state) {
    times.time([&] {
      reconstructor.push(static_cast<double>(frame) / model->frame_rate,
                         inputs[frame % inputs.size()]);
      while (reconstructor.next()) benchmark::DoNotOptimize(reconstructor.frame().hips);
    });
    ++frame;
  }
  times.report(state);
}

// The same sizes without everything around them: a triangular solve per state, one product with a
// gain, the banded systems of all output values.
struct Floor {
  explicit Floor(const Model& model)
      : tables(make_state_tables(model)),
        x(Eigen::VectorXf::Random(tables->padded)),
        white(Eigen::VectorXf::Zero(tables->padded)),
        y(tables->outputs),
        trajectory(model.output.statics(), past, 1, 0),
        gaussian{Eigen::VectorXf::Random(model.output.size()),
                 Eigen::VectorXf::Ones(model.output.size())} {
    for (int i = 0; i < 3; ++i) trajectory.push(gaussian);
    for (const Label& label : model.labels)
      for (const State& state : label.states) {
        const Eigen::MatrixXd xx =
            state.covariance.topLeftCorner(model.input.size(), model.input.size());
        factors.push_back(Eigen::MatrixXd(xx.llt().matrixL()).cast<float>());
      }
  }

  std::shared_ptr<const StateTables> tables;
  std::vector<Eigen::MatrixXf> factors;
  Eigen::VectorXf x, white, y;
  Trajectory trajectory;
  OutputGaussian gaussian;
};

void floor_of_frame(benchmark::State& state, int states, bool ours) {
  Floor floor(*bench_model(states));
  const auto inputs = static_cast<Eigen::Index>(floor.tables->kept.size());
  FrameTimes times;
  for (auto _ : state)
    times.time([&] {
      float sum = 0;
      for (std::size_t i = 0; i < floor.factors.size(); ++i) {
        if (ours) {
          multiply(floor.tables->states[i].whitener, floor.x.data(), static_cast<int>(inputs),
                   floor.white.data());
        } else {
          floor.white.head(inputs) = floor.x.head(inputs);
          auto white = floor.white.head(inputs);
          floor.factors[i].triangularView<Eigen::Lower>().solveInPlace(white);
        }
        sum += floor.white.head(inputs).squaredNorm();
      }
      floor.y.noalias() = floor.tables->states[0].gain * floor.white.head(inputs);
      floor.trajectory.push(floor.gaussian);
      benchmark::DoNotOptimize(floor.trajectory.generate()(0, 0));
      benchmark::DoNotOptimize(sum + floor.y[0]);
    });
  times.report(state);
}

BENCHMARK_CAPTURE(whole_frame, viterbi_5_states, 5, DecoderKind::viterbi);
BENCHMARK_CAPTURE(whole_frame, viterbi_8_states_default, 8, DecoderKind::viterbi);
BENCHMARK_CAPTURE(whole_frame, forward_8_states, 8, DecoderKind::forward);
BENCHMARK_CAPTURE(whole_frame, forward_12_states, 12, DecoderKind::forward);
BENCHMARK_CAPTURE(floor_of_frame, our_kernels_5_states, 5, true);
BENCHMARK_CAPTURE(floor_of_frame, eigen_5_states, 5, false);
BENCHMARK_CAPTURE(floor_of_frame, our_kernels_8_states, 8, true);
BENCHMARK_CAPTURE(floor_of_frame, eigen_8_states, 8, false);

}  // namespace
}  // namespace gait::bench

BENCHMARK_MAIN();
