// Enrolment: a stranger merged into a model, against training on both and against truth left out.
#include "gait/teach/enrolment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gait/corpus/corpus.h"
#include "gait/error.h"
#include "gait/judge/evaluation.h"
#include "gait/learn/trainer.h"
#include "gait/motion/rotation.h"
#include "gait/teach/walk_model.h"

namespace gait {
namespace {

std::vector<Walk> corpus_walks(const std::string& style, int first, int last) {
  std::vector<Walk> walks;
  for (const CorpusWalk& made : make_corpus())
    if (made.style == style && made.take >= first && made.take <= last)
      walks.push_back({made.clip, made.style, {}, {}, made.contacts});
  return walks;
}

// One who walks as nobody in the model does: legs turned, which the upper body does not tell.
std::vector<Walk> stranger(int first, int last, double turned = 0.15) {
  std::vector<Walk> walks = corpus_walks("decided", first, last);
  for (Walk& walk : walks) {
    walk.style.clear();
    walk.subject = "stranger";
    const int joints = walk.clip.skeleton.size();
    for (std::size_t i = 0; i < walk.clip.rotations.size(); ++i) {
      const std::string& name = walk.clip.skeleton.joints[i % joints].name;
      if (name == "LeftUpLeg" || name == "RightUpLeg")
        walk.clip.rotations[i] =
            walk.clip.rotations[i] * exponential_map<double>({-turned, 0, turned});
    }
  }
  return walks;
}

Model taught() {
  std::vector<Walk> walks = corpus_walks("decided", 1, 2);
  for (const char* style : {"sad", "proud"})
    for (Walk& walk : corpus_walks(style, 1, 2)) walks.push_back(walk);
  SelectionOptions options;
  options.regularisation = 30;
  options.rounds = 0;
  options.learning.states = 4;
  options.learning.hmm.threads = 1;
  return learn_walks(walks, {}, {}, options, {}).selected.model;
}

const Model& taught_once() {
  static const Model model = taught();
  return model;
}

double error_on(const Model& model, const std::vector<Walk>& walks) {
  return evaluate(std::make_shared<const Model>(model), walks, {})
      .error(Estimate::synthesised)
      .over_clips;
}

TEST(Enrolment, a_stranger_is_found_better_on_walks_that_were_not_enrolled) {
  const Enrolled enrolled = enrol(taught_once(), stranger(1, 1));
  EXPECT_GE(enrolled.cycles, 2);
  EXPECT_LT(enrolled.error_after, enrolled.error_before);
  const double before = error_on(taught_once(), stranger(3, 3));
  EXPECT_LT(error_on(enrolled.model, stranger(3, 3)), 0.7 * before);
  EXPECT_EQ(enrolled.model.training.subjects, std::vector<std::string>{"stranger"});
}

TEST(Enrolment, the_same_clips_again_move_the_model_less) {
  const Model once = enrol(taught_once(), stranger(1, 1)).model;
  const Model twice = enrol(once, stranger(1, 1)).model;
  const auto distance = [](const Model& a, const Model& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.labels.size(); ++i)
      for (std::size_t k = 0; k < a.labels[i].states.size(); ++k)
        sum += (a.labels[i].states[k].mean - b.labels[i].states[k].mean).norm();
    return sum;
  };
  EXPECT_LT(distance(once, twice), 0.8 * distance(taught_once(), once));
}

// At weight 1, states are those of all frames together at the scaling of the first: here by raw
// sums over the stranger's frames, observed once more.
TEST(Enrolment, at_weight_one_is_training_on_both) {
  const Model& model = taught_once();
  EnrolmentOptions options;
  options.weight = 1;
  const std::vector<Walk> walks = stranger(1, 1);
  const Model merged = enrol(model, walks, options).model;

  const int inputs = model.input.size(), all = inputs + model.output.size();
  const double kappa = model.training.regularisation;
  Eigen::VectorXd sensor = Eigen::VectorXd::Zero(all);
  sensor.head(inputs) = sensor_variance(model, 0);
  double taught_frames = 0, merged_frames = 0;
  for (std::size_t label = 0; label < 2; ++label)
    for (std::size_t k = 0; k < model.labels[label].states.size(); ++k) {
      const State &before = model.labels[label].states[k], &after = merged.labels[label].states[k];
      taught_frames += before.weight, merged_frames += after.weight;
      const double more = after.weight - before.weight, total = after.weight;
      ASSERT_GT(more, 0);
      // Raw second moments of the first set, and what must have come on top of them.
      const auto moments = [&](const State& state) {
        Eigen::MatrixXd covariance = state.covariance;
        covariance.diagonal() -= sensor;
        covariance *= state.weight + kappa;
        covariance.diagonal() -= kappa * model.training.target;
        return Eigen::MatrixXd(covariance + state.weight * state.mean * state.mean.transpose());
      };
      const Eigen::MatrixXd added = moments(after) - moments(before);
      const Eigen::VectorXd sum = total * after.mean - before.weight * before.mean;
      // Frames' own second moments: symmetric, of rank `more` at most, scattered about their mean.
      const Eigen::MatrixXd scatter = added - sum * sum.transpose() / more;
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scatter);
      const double largest = eigen.eigenvalues().maxCoeff();
      EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-7 * std::max(1.0, largest));
      const auto rank = (eigen.eigenvalues().array() > 1e-7 * largest).count();
      EXPECT_LE(rank, std::max(0.0, more - 1)) << "no more than " << more << " frames were added";
    }
  EXPECT_GT(merged_frames, taught_frames + 40);
}

TEST(Enrolment, what_cannot_be_enrolled_is_refused_in_one_clear_word) {
  const auto said = [](const Model& model, const std::vector<Walk>& walks) -> std::string {
    try {
      enrol(model, walks);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const auto expect_says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  Model old = taught_once();
  old.training.target.resize(0);
  expect_says(said(old, stranger(1, 1)), "train it again");
  Model bodiless = taught_once();
  bodiless.body.reset();
  expect_says(said(bodiless, stranger(1, 1)), "a model of a body");
  expect_says(said(taught_once(), {}), "whole cycles");

  std::vector<Walk> brief = stranger(1, 1);
  brief[0].clip.rotations.resize(static_cast<std::size_t>(40 * brief[0].clip.skeleton.size()));
  brief[0].clip.translations.resize(brief[0].clip.rotations.size());
  brief[0].contacts.clear();
  expect_says(said(taught_once(), brief), "2 whole cycles");

  std::vector<Walk> another = stranger(1, 1);
  another[0].clip.skeleton.joints[2].name = "Thorax";
  expect_says(said(taught_once(), another), taught_once().body->skeleton.joints[2].name);
}

TEST(Enrolment, sloppy_legs_are_enrolled_only_where_they_help) {
  // Legs that jerk at random in what is enrolled say nothing of the walk.
  std::vector<Walk> noisy = stranger(1, 1, 0);
  unsigned seed = 1;
  for (std::size_t i = 0; i < noisy[0].clip.rotations.size(); ++i) {
    const std::string& name =
        noisy[0].clip.skeleton.joints[i % noisy[0].clip.skeleton.joints.size()].name;
    seed = seed * 1664525u + 1013904223u;
    if (name.find("Leg") != std::string::npos)
      noisy[0].clip.rotations[i] =
          noisy[0].clip.rotations[i] *
          exponential_map<double>({0, 0, 1.5 * (seed / 4294967296.0 - 0.5)});
  }
  try {
    const Enrolled enrolled = enrol(taught_once(), noisy);
    EXPECT_LT(enrolled.error_after, enrolled.error_before);
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("the model stays as it was"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace gait
