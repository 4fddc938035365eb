// Gestures from a generator with noise, time-warping and scale: recognised, and others rejected;
// and parameters learnt by demonstration.
#include "gait/teach/takes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "gait/error.h"
#include "gait/judge/played_sequence.h"

namespace gait {
namespace {

constexpr double pi = std::numbers::pi;

using Path = Eigen::Vector2d (*)(double share);

// What a hand draws in the air, each from 0 to 1 of its time.
const std::vector<std::pair<std::string, Path>> taught{
    {"circle",
     [](double s) { return Eigen::Vector2d(std::cos(2 * pi * s) - 1, std::sin(2 * pi * s)); }},
    {"zigzag",
     [](double s) {
       return Eigen::Vector2d(2 * s, 0.5 * std::asin(std::sin(6 * pi * s)) / (pi / 2));
     }},
    {"flick", [](double s) { return Eigen::Vector2d(std::sin(pi * s), 2 * s * s); }}};
const std::vector<std::pair<std::string, Path>> others{
    {"eight",
     [](double s) { return Eigen::Vector2d(std::sin(4 * pi * s), 1.2 * std::sin(2 * pi * s)); }},
    {"back and forth",
     [](double s) { return Eigen::Vector2d(-1.5 * std::sin(2 * pi * s), 0.1 * s); }},
    {"down", [](double s) { return Eigen::Vector2d(0.3 * s, -2 * s); }}};

Take drawn(const std::string& label, Path path, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0, 0.02);
  std::uniform_real_distribution<double> share(-1, 1);
  const int frames = static_cast<int>(40 * (1 + 0.25 * share(random)));
  const double size = 1 + 0.2 * share(random), bend = 0.15 * share(random);
  Take take;
  take.label = label;
  take.inputs.resize(2, frames);
  for (int frame = 0; frame < frames; ++frame) {
    const double s = static_cast<double>(frame) / (frames - 1);
    const double warped = s + bend * std::sin(pi * s) / pi;
    take.inputs.col(frame) = size * path(warped) + Eigen::Vector2d(noise(random), noise(random));
  }
  return take;
}

// As a stage would: the take played from its beginning, the label that led in most of its frames,
// and the mean distance.
struct Heard {
  int label = 0;
  double distance = 0;
};

Heard heard(const std::shared_ptr<const Model>& model, const Take& take) {
  Sequence sequence;
  const int history = model->input.lags.back();
  const auto frames = take.inputs.cols();
  sequence.inputs.resize(take.inputs.rows(), history + frames);
  sequence.inputs << take.inputs.col(0).replicate(1, history), take.inputs;
  sequence.outputs = sequence.inputs;
  sequence.segments = {{history, history + static_cast<int>(frames), 0}};
  const PlayedSequence played = play_sequence(model, {}, sequence);
  std::vector<int> votes(model->labels.size(), 0);
  Heard result;
  for (int frame = played.begin; frame < played.end; ++frame) {
    ++votes[played.decisions[frame].label];
    result.distance +=
        played.decisions[frame].distance / static_cast<double>(played.end - played.begin);
  }
  result.label = static_cast<int>(std::ranges::max_element(votes) - votes.begin());
  return result;
}

TEST(Takes, of_three_gestures_are_recognised_and_others_rejected) {
  std::mt19937_64 random(1);
  std::vector<Take> takes;
  for (int i = 0; i < 10; ++i)
    for (const auto& [label, path] : taught) takes.push_back(drawn(label, path, random));
  const TakesLearnt learnt = learn_takes(takes);
  EXPECT_GE(learnt.judged.accuracy, 0.98);
  EXPECT_EQ(learnt.judged.takes, 30);

  const auto model = std::make_shared<const Model>(learnt.model);
  ASSERT_EQ(model->labels.size(), 3u);
  int right = 0, accepted = 0, known = 0, rejected = 0, unknown = 0;
  for (int i = 0; i < 100; ++i) {
    for (std::size_t label = 0; label < taught.size(); ++label) {
      const Heard take = heard(model, drawn("", taught[label].second, random));
      right += take.label == static_cast<int>(label);
      accepted += take.distance <= model->play.usual_distance;
      ++known;
    }
    for (const auto& [label, path] : others) {
      rejected += heard(model, drawn("", path, random)).distance > model->play.usual_distance;
      ++unknown;
    }
  }
  std::printf("recognised %.3f, falsely rejected %.3f, others rejected %.3f; usual distance %.2f\n",
              double(right) / known, 1 - double(accepted) / known, double(rejected) / unknown,
              model->play.usual_distance);
  EXPECT_GE(double(right) / known, 0.98);
  EXPECT_GE(double(accepted) / known, 0.95);  // 2 % of thirty takes is less than one
  EXPECT_GE(double(rejected) / unknown, 0.9);
}

// Two parameters that follow three inputs through a lag and a bend, which no single frame tells.
Take demonstrated(std::mt19937_64& random) {
  std::normal_distribution<double> noise(0, 0.02);
  std::uniform_real_distribution<double> share(-1, 1);
  const int frames = 150;
  const double speed = 1 + 0.2 * share(random), size = 1 + 0.2 * share(random);
  Take take;
  take.label = "demonstration";
  take.inputs.resize(3, frames);
  take.outputs.resize(2, frames);
  for (int frame = 0; frame < frames; ++frame) {
    const double s = speed * frame / 30.0;
    take.inputs.col(frame) = size * Eigen::Vector3d(std::sin(2 * s), std::cos(2 * s), std::sin(s)) +
                             Eigen::Vector3d(noise(random), noise(random), noise(random));
    take.outputs.col(frame) = Eigen::Vector2d(400 + 200 * size * std::sin(2 * s - 0.5),
                                              0.5 + 0.4 * std::tanh(2 * std::sin(s)));
  }
  return take;
}

TEST(Takes, teach_parameters_by_demonstration_better_than_the_nearest_frame_or_a_state) {
  std::mt19937_64 random(2);
  std::vector<Take> takes;
  for (int i = 0; i < 8; ++i) takes.push_back(demonstrated(random));
  const TakesLearnt learnt = learn_takes(takes);
  EXPECT_EQ(learnt.model.output.values, 2);
  const auto model = std::make_shared<const Model>(learnt.model);

  double ours = 0, nearest = 0, mapped = 0, our_jerk = 0, nearest_jerk = 0, mapped_jerk = 0;
  const Eigen::Array2d unit(200, 0.4);
  for (int i = 0; i < 5; ++i) {
    const Take held = demonstrated(random);
    Sequence sequence;
    sequence.inputs = held.inputs, sequence.outputs = held.outputs;
    sequence.segments = {{10, static_cast<int>(held.inputs.cols()) - 1, 0}};
    const PlayedSequence played = play_sequence(model, {}, sequence);
    // Without past frames there is no trajectory: each state's regression alone.
    PlaySettings no_trajectory;
    no_trajectory.past = 0;
    const PlayedSequence by_state = play_sequence(model, no_trajectory, sequence);
    Eigen::MatrixXd by_frame(2, held.inputs.cols());
    for (int frame = 0; frame < by_frame.cols(); ++frame) {
      double best = 1e9;
      for (const Take& take : takes)
        for (int other = 0; other < take.inputs.cols(); ++other)
          if (const double far = (take.inputs.col(other) - held.inputs.col(frame)).squaredNorm();
              far < best)
            best = far, by_frame.col(frame) = take.outputs.col(other);
    }
    const auto jerk = [&](const Eigen::MatrixXd& path, int frame) {
      return ((path.col(frame) - 3 * path.col(frame - 1) + 3 * path.col(frame - 2) -
               path.col(frame - 3))
                  .array() /
              unit)
          .abs()
          .sum();
    };
    for (int frame = played.begin + 3; frame < played.end; ++frame) {
      ours += ((played.outputs - held.outputs).col(frame).array() / unit).abs().sum();
      nearest += ((by_frame - held.outputs).col(frame).array() / unit).abs().sum();
      mapped += ((by_state.outputs - held.outputs).col(frame).array() / unit).abs().sum();
      mapped_jerk += jerk(by_state.outputs, frame);
      our_jerk += jerk(played.outputs, frame);
      nearest_jerk += jerk(by_frame, frame);
    }
  }
  std::printf(
      "error %.3f of the nearest frame's and %.3f of the states', jerk %.3f and %.3f of "
      "theirs; judged error %.3f\n",
      ours / nearest, ours / mapped, our_jerk / nearest_jerk, our_jerk / mapped_jerk,
      learnt.judged.error);
  EXPECT_LT(ours, mapped);
  EXPECT_LT(our_jerk, mapped_jerk);
  EXPECT_LT(ours, nearest);
  EXPECT_LT(our_jerk, nearest_jerk);
}

TEST(Takes, that_do_not_fit_are_named) {
  std::mt19937_64 random(3);
  const auto said = [](const std::vector<Take>& takes) -> std::string {
    try {
      learn_takes(takes);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(said({}), "expected at least one take; found none");
  std::vector<Take> takes{drawn("a", taught[0].second, random),
                          drawn("b", taught[1].second, random)};
  takes[1].inputs.conservativeResize(2, 3);
  EXPECT_EQ(said(takes), "take 1 ('b'): expected at least 5 frames; found 3");
  takes[1].inputs = Eigen::MatrixXd::Random(3, 30);
  EXPECT_EQ(said(takes), "take 1 ('b'): expected 2 input values, as in the first take; found 3");
  takes[1].inputs = Eigen::MatrixXd::Constant(2, 30, NAN);
  EXPECT_EQ(said(takes), "take 1 ('b'): expected finite values; found others");
  for (Take& take : takes) take.inputs = Eigen::MatrixXd::Constant(2, 30, 0.5);
  EXPECT_NE(said(takes).find("expected input streams that move"), std::string::npos);
}

}  // namespace
}  // namespace gait
