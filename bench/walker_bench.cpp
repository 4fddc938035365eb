// What one frame of the style walker costs, and fitting its space.
#include <benchmark/benchmark.h>

#include "gait/corpus/corpus.h"
#include "gait/learn/cycles.h"
#include "gait/learn/principal_components.h"
#include "gait/play/body/root_motion.h"
#include "gait/play/cycles/style_walker.h"
#include "gait/teach/walk_model.h"

namespace gait::bench {
namespace {

// The built-in walks' space alone: the walker needs no states.
std::shared_ptr<const Model> styles_model() {
  static const std::shared_ptr<const Model> model = [] {
    std::vector<Walk> walks;
    for (CorpusWalk& walk : make_corpus())
      walks.push_back({std::move(walk.clip), walk.style, {}, {}, std::move(walk.contacts)});
    const WalkSequences sequences = walk_sequences(walks, {});
    auto made = std::make_shared<Model>();
    made->styles = sequences.styles;
    made->body = sequences.body;
    add_style_space(*made, walks);
    return made;
  }();
  return model;
}

void style_walker_frame(benchmark::State& state, bool with_root) {
  const auto model = styles_model();
  StyleWalker walker(model, 1);
  RootMotion root(model->body->skeleton, body_roles(*model->body), 60);
  walker.set_style(4);
  for (auto _ : state) {
    walker.advance(1 / 60.0);
    if (with_root) benchmark::DoNotOptimize(root.advance(walker.pose()));
    benchmark::DoNotOptimize(walker.pose().data());
  }
}

// 165 cycles of 2160 values, as in T10, and more than a dense SVD likes.
void fit_components(benchmark::State& state) {
  const Eigen::MatrixXd rows = Eigen::MatrixXd::Random(state.range(0), 2160);
  for (auto _ : state) {
    Eigen::MatrixXd centred = rows;
    benchmark::DoNotOptimize(principal_components(centred, {.share = 0.9}).variances.data());
  }
}

BENCHMARK_CAPTURE(style_walker_frame, pose, false);
BENCHMARK_CAPTURE(style_walker_frame, pose_and_root, true);
BENCHMARK(fit_components)->Arg(165)->Unit(benchmark::kMillisecond);
BENCHMARK(fit_components)->Arg(20000)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gait::bench
