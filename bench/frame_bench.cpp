// What one frame costs, beside the arithmetic that no way of doing it can avoid.
//
// Each benchmark times single frames and reports their median, 99th percentile and largest in
// microseconds, as a performer meets them.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <random>
#include <string>

#include "bench_model.h"
#include "gait/play/recognise/state_tables.h"
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

// The same sizes without everything around them: a whitening per state, one product with a gain and
// one with style weights, the banded systems of all output values.
struct Floor {
  explicit Floor(const Model& model)
      : tables(make_state_tables(model)),
        x(Eigen::VectorXf::Random(PackedMap::padded(model.input.size()))),
        white(x),
        y(PackedMap::padded(tables->outputs)),
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
  Eigen::MatrixXf gain = Eigen::MatrixXf::Random(tables->outputs, tables->kept.size());
  Eigen::VectorXf x, white, y;
  Trajectory trajectory;
  OutputGaussian gaussian;
};

enum class FloorKind { kernels, eigen, bytes };

void floor_of_frame(benchmark::State& state, int states, FloorKind kind) {
  Floor floor(*bench_model(states));
  const auto inputs = static_cast<Eigen::Index>(floor.tables->kept.size());
  const int count = static_cast<int>(inputs);
  // What must be read of the tables, once: the factors' triangles, a gain, the weights of styles.
  const std::string bytes(
      sizeof(float) *
          static_cast<std::size_t>(std::ssize(floor.factors) * inputs * (inputs + 1) / 2 +
                                   inputs * (floor.tables->outputs + floor.tables->styles)),
      ' ');
  FrameTimes times;
  for (auto _ : state)
    times.time([&] {
      float sum = 0;
      if (kind == FloorKind::bytes) {
        // The C library's search is the fastest reading that every machine has.
        benchmark::DoNotOptimize(std::memchr(bytes.data(), 'x', bytes.size()));
      } else if (kind == FloorKind::kernels) {
        for (const PlayedState& played : floor.tables->states)
          sum += played.whitener.apply(floor.x.data(), count, floor.white.data());
        floor.tables->states[0].gain.apply(floor.white.data(), count, floor.y.data());
        floor.tables->states[0].style_scores.back().apply(floor.x.data(), count,
                                                          floor.white.data());
      } else {
        for (const Eigen::MatrixXf& factor : floor.factors) {
          auto white = floor.white.head(inputs);
          white = floor.x.head(inputs);
          factor.triangularView<Eigen::Lower>().solveInPlace(white);
          sum += white.squaredNorm();
        }
        floor.y.head(floor.gain.rows()).noalias() = floor.gain * floor.white.head(inputs);
      }
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
BENCHMARK_CAPTURE(floor_of_frame, our_kernels_5_states, 5, FloorKind::kernels);
BENCHMARK_CAPTURE(floor_of_frame, eigen_5_states, 5, FloorKind::eigen);
BENCHMARK_CAPTURE(floor_of_frame, bytes_5_states, 5, FloorKind::bytes);
BENCHMARK_CAPTURE(floor_of_frame, our_kernels_8_states, 8, FloorKind::kernels);
BENCHMARK_CAPTURE(floor_of_frame, eigen_8_states, 8, FloorKind::eigen);

}  // namespace
}  // namespace gait::bench

BENCHMARK_MAIN();
