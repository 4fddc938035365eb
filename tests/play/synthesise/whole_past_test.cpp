// The factorisation that is carried from frame to frame, against the whole past solved at once,
// over ten minutes in which everything changes.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "gait/play/map/observation_map.h"
#include "gait/play/recognise/live_recogniser.h"
#include "gait/play/synthesise/synthesiser.h"
#include "gait/play/synthesise/trajectory.h"
#include "play/played_stream.h"
#include "play/synthesise/direct_path.h"

namespace gait {
namespace {

using testing::direct_path;
using testing::ValueGaussian;

constexpr int ten_minutes = 600 * 30;  // frames
constexpr double tolerance = 1e-5;

TEST(WholePast, is_carried_exactly_whatever_the_queue_and_the_gaussians) {
  constexpr int values = 5;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const auto& [current, future] : {std::pair(1, 0), {1, 1}, {1, 6}, {3, 4}}) {
    Trajectory trajectory(values, whole_past, current, future);
    std::vector<std::vector<ValueGaussian>> told(values);
    OutputGaussian gaussian{Eigen::VectorXf(3 * values), Eigen::VectorXf(3 * values)};
    double size = 1, spread = 1, sureness = 1;
    int checked = 0;
    for (int frame = 0; frame < ten_minutes; ++frame) {
      if (frame % 1000 == 0) {  // strength, spread, the model: at once
        size = std::exp2(normal(random));
        spread = std::exp2(3 * normal(random));
        sureness = std::pow(10, -1 - std::abs(normal(random)));
      }
      for (int value = 0; value < values; ++value) {
        const double phase = 0.1 * frame + value;
        ValueGaussian& of = told[value].emplace_back();
        for (int part = 0; part < 3; ++part) {
          const int at = part * values + value;
          gaussian.mean[at] = static_cast<float>(
              size * (std::sin(phase + part * std::numbers::pi / 2) * std::pow(0.1, part) +
                      0.1 * normal(random)));
          gaussian.variance[at] =
              static_cast<float>(spread * std::pow(sureness, part) * std::exp2(normal(random)));
          of.mean[part] = gaussian.mean[at], of.variance[part] = gaussian.variance[at];
        }
      }
      trajectory.push(gaussian);
      if (!trajectory.ready()) continue;
      const auto path = trajectory.generate();
      if (frame > 40 && frame % 1500 > 2 * current) continue;
      ++checked;
      for (int value = 0; value < values; ++value) {
        const Eigen::VectorXd all = direct_path(told[value]);
        const Eigen::VectorXd expected = all.segment(frame + 1 - current - future, current);
        EXPECT_LT((path.row(value).transpose().cast<double>() - expected).cwiseAbs().maxCoeff(),
                  tolerance * std::max(1.0, size))
            << "C " << current << " F " << future << " frame " << frame;
      }
    }
    EXPECT_GT(checked, 20);
  }
}

// The model with means and regressions of its own.
std::shared_ptr<const Model> another_model() {
  auto model = std::make_shared<Model>(*testing::few_walks_model());
  for (Label& label : model->labels)
    for (State& state : label.states) state.mean *= 0.9;
  return model;
}

TEST(WholePast, is_carried_exactly_through_strength_mask_decoder_and_model) {
  Eigen::MatrixXf inputs = testing::held_out_inputs("sad");
  const Eigen::MatrixXf proud = testing::held_out_inputs("proud");
  inputs.conservativeResize(Eigen::NoChange, inputs.cols() + proud.cols());
  inputs.rightCols(proud.cols()) = proud;

  const std::shared_ptr<const Model> models[] = {testing::few_walks_model(), another_model()};
  const int values = models[0]->output.values;
  const std::vector<int>& modelled = models[0]->output.modelled;
  std::vector<std::vector<ValueGaussian>> told(modelled.size());
  auto synthesiser = std::make_unique<Synthesiser>(models[0]);
  ASSERT_EQ(synthesiser->past(), whole_past) << "what a model has unless it says otherwise";
  constexpr int scene = 500;  // frames until something changes
  for (int from = 0, number = 0; from < ten_minutes; from += scene, ++number) {
    const auto& model = models[number / 4 % 2];
    RecogniserSettings settings;
    settings.decoder = number % 3 == 0   ? DecoderKind::viterbi
                       : number % 3 == 1 ? DecoderKind::forward
                                         : DecoderKind::lag;
    LiveRecogniser recogniser(model, settings);
    ObservationMap map(model);
    map.set_strength(0.5f * static_cast<float>(number % 5));
    map.set_spread(number % 2 == 0 ? 1.0f : 5.0f);
    recogniser.set_missing(0, number % 4 == 3);
    if (&synthesiser->model() != model.get()) {
      auto next = std::make_unique<Synthesiser>(model);
      ASSERT_TRUE(next->take_over(*synthesiser));
      synthesiser = std::move(next);
    }
    for (int i = 0; i < scene; ++i) {
      if (!recogniser.advance(
              testing::frame_of(inputs, (from + i) % static_cast<int>(inputs.cols()))))
        continue;
      map.map(recogniser.recogniser());
      ASSERT_TRUE(synthesiser->push(map.mean(), map.variance()));
      for (std::size_t j = 0; j < modelled.size(); ++j) {
        ValueGaussian& of = told[j].emplace_back();
        for (int part = 0; part < 3; ++part) {
          of.mean[part] = map.mean()[part * values + modelled[j]];
          of.variance[part] = map.variance()[part * values + modelled[j]] *
                              static_cast<float>(part == 0 ? 1 : model->play.easing);
        }
      }
    }
    if (number % 5 != 0 && from + scene < ten_minutes) continue;
    for (std::size_t j = 0; j < modelled.size(); ++j) {
      const Eigen::VectorXd path = direct_path(told[j]);
      EXPECT_NEAR(synthesiser->outputs()[modelled[j]], path[path.size() - 1], tolerance)
          << "value " << j << " after " << path.size() << " frames";
    }
  }
}

TEST(WholePast, is_as_near_as_the_frames_kept_when_the_queues_length_is_set) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  const auto next = [&] {
    OutputGaussian gaussian{Eigen::VectorXf::NullaryExpr(9, [&] { return normal(random); }),
                            Eigen::VectorXf::Constant(9, 0.5f)};
    gaussian.variance.tail(6).setConstant(0.05f);
    return gaussian;
  };
  Trajectory carried(3, whole_past, 1, 0), set(3, 6, 1, 0);
  for (int i = 0; i < 100; ++i) {
    const OutputGaussian gaussian = next();
    carried.push(gaussian);
    set.push(gaussian);
  }
  Trajectory late = carried;
  carried.resize(6, 0);
  EXPECT_EQ(Eigen::MatrixXf(carried.generate()), Eigen::MatrixXf(set.generate()));
  // Another future goes on with the same past, as if it had always been so.
  late.resize(whole_past, 4);
  ASSERT_TRUE(late.ready());
  Trajectory always(3, whole_past, 1, 4);
  std::mt19937 same(7);
  random = same;
  normal.reset();
  for (int i = 0; i < 100; ++i) always.push(next());
  EXPECT_EQ(Eigen::MatrixXf(late.generate()), Eigen::MatrixXf(always.generate()));
  // From a set past it is the whole one of the frames that the queue held.
  set.resize(whole_past, 0);
  carried.resize(whole_past, 0);
  const OutputGaussian gaussian = next();
  set.push(gaussian), carried.push(gaussian);
  EXPECT_EQ(Eigen::MatrixXf(set.generate()), Eigen::MatrixXf(carried.generate()));
}

}  // namespace
}  // namespace gait
