#include "gait/judge/model_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "gait/error.h"

namespace gait {
namespace {

// Takes of two labels in turn: many inputs and a few outputs that hang together by what the take's
// own posture is, and noise on top.
LearningTask task_of(int takes, int steps, int inputs, double noise_deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  LearningTask task;
  task.inputs = {{"in", inputs, StreamKind::plain}};
  task.outputs = {{"out", 2, StreamKind::plain}};
  task.labels = {{"right", {1}}, {"left", {0}}};
  task.styles = {"wide", "narrow"};
  for (int take = 0; take < takes; ++take) {
    Sequence sequence;
    sequence.name = "take " + std::to_string(take);
    sequence.style = take % 2;
    const int length = 12 + take % 3, frames = (steps + 2) * length;
    const double posture = normal(random), swing = (take % 2 ? 0.7 : 1.2) + 0.2 * normal(random);
    sequence.inputs.resize(inputs, frames);
    sequence.outputs.resize(2, frames);
    for (int frame = 0; frame < frames; ++frame) {
      const double phase = std::numbers::pi * frame / length;
      for (int i = 0; i < inputs; ++i)
        sequence.inputs(i, frame) = swing * std::sin(phase + 0.4 * i) +
                                    posture * std::cos(1.3 * i) + noise_deviation * normal(random);
      for (int i = 0; i < 2; ++i)
        sequence.outputs(i, frame) =
            swing * std::cos(phase + i) + 0.5 * posture + noise_deviation * normal(random);
    }
    for (int step = 0; step < steps; ++step)
      sequence.segments.push_back({(step + 1) * length, (step + 2) * length, step % 2});
    task.sequences.push_back(sequence);
  }
  return task;
}

SelectionOptions quick() {
  SelectionOptions options;
  options.learning.states = 3;
  options.learning.history = {1.0 / 30, 4.0 / 30};
  options.learning.hmm.threads = 2;
  options.regularisations = {1, 10, 100, 1000};
  options.round_choices = {0, 2};
  options.folds = 3;
  return options;
}

TEST(ModelSelection, chooses_what_did_best_on_held_out_takes) {
  const Selected selected = select_model(task_of(6, 8, 5, 0.1, 1), quick());
  EXPECT_EQ(selected.folds, 3);
  ASSERT_EQ(selected.trials.size(), 6u) << "four of kappa, two of rounds";
  const auto best =
      std::min_element(selected.trials.begin(), selected.trials.begin() + 4,
                       [](const Trial& a, const Trial& b) { return a.error < b.error; });
  EXPECT_EQ(selected.model.training.regularisation, best->regularisation);
  EXPECT_EQ(selected.model.training.regularisation_chosen_by, "cross-validation");
  for (const Trial& trial : selected.trials) {
    EXPECT_GT(trial.error, 0);
    EXPECT_LT(trial.error, 5);
  }
  const Training& training = selected.model.training;
  EXPECT_GT(training.validated_error, 0);
  EXPECT_GT(training.validated_step_accuracy, 0.8);
  EXPECT_GT(training.validated_style_accuracy, 0.5);
  EXPECT_LE(training.validated_calibration_error, 1);
  const std::vector<double> tempers = quick().tempers;
  EXPECT_TRUE(std::count(tempers.begin(), tempers.end(), selected.model.play.temper));
}

TEST(ModelSelection, regularises_more_where_there_is_little_and_noisy_data) {
  SelectionOptions options = quick();
  options.rounds = 0;
  options.regularisations = {1, 3, 10, 30, 100, 300, 1000};
  const double plenty =
      select_model(task_of(8, 30, 4, 0.05, 2), options).model.training.regularisation;
  const double little =
      select_model(task_of(3, 3, 12, 1.0, 2), options).model.training.regularisation;
  EXPECT_GT(little, plenty);
}

void expect_same(const Model& a, const Model& b) {
  ASSERT_EQ(a.labels.size(), b.labels.size());
  for (std::size_t label = 0; label < a.labels.size(); ++label)
    for (std::size_t k = 0; k < a.labels[label].states.size(); ++k) {
      const State &one = a.labels[label].states[k], &other = b.labels[label].states[k];
      EXPECT_EQ(one.mean, other.mean);
      EXPECT_EQ(one.covariance, other.covariance);
      EXPECT_EQ(one.style_means, other.style_means);
      EXPECT_EQ(one.stay, other.stay);
    }
  EXPECT_EQ(a.play.temper, b.play.temper);
  EXPECT_EQ(a.play.style_temper, b.play.style_temper);
  EXPECT_EQ(a.training.regularisation, b.training.regularisation);
  EXPECT_EQ(a.training.validated_error, b.training.validated_error);
  EXPECT_EQ(a.training.validated_calibration_error, b.training.validated_calibration_error);
}

TEST(ModelSelection, is_the_same_for_any_number_of_threads) {
  const LearningTask task = task_of(5, 6, 5, 0.3, 3);
  SelectionOptions options = quick();
  options.learning.hmm.threads = 1;
  const Selected one = select_model(task, options);
  for (const int threads : {2, 4}) {
    options.learning.hmm.threads = threads;
    const Selected many = select_model(task, options);
    expect_same(one.model, many.model);
    ASSERT_EQ(one.trials.size(), many.trials.size());
    for (std::size_t i = 0; i < one.trials.size(); ++i)
      EXPECT_EQ(one.trials[i].error, many.trials[i].error);
  }
}

TEST(ModelSelection, takes_of_the_same_name_are_judged_by_their_own_truth) {
  LearningTask task = task_of(5, 6, 5, 0.3, 4);
  const Selected apart = select_model(task, quick());
  for (Sequence& sequence : task.sequences) sequence.name = "walk.bvh";
  const Selected alike = select_model(task, quick());
  expect_same(apart.model, alike.model);
}

// Takes of three people, of whom each has a posture of his own that inputs do not tell.
LearningTask task_of_people(unsigned seed) {
  LearningTask task = task_of(12, 6, 6, 0.1, seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector2d> postures;
  for (int person = 0; person < 3; ++person) postures.emplace_back(normal(random), normal(random));
  for (std::size_t take = 0; take < task.sequences.size(); ++take) {
    task.sequences[take].subject = "person " + std::to_string(take / 4);
    task.sequences[take].outputs.colwise() += 3 * postures[take / 4];
  }
  return task;
}

TEST(ModelSelection, leaves_people_out_where_takes_name_them_and_says_how_strangers_fare) {
  const LearningTask task = task_of_people(11);
  const Selected selected = select_model(task, quick());
  const Training& training = selected.model.training;
  EXPECT_EQ(selected.subjects, 3);
  EXPECT_EQ(training.subjects, (std::vector<std::string>{"person 0", "person 1", "person 2"}));
  EXPECT_GT(training.validated_error, 0);
  EXPECT_GT(training.strangers_error, 1.3 * training.validated_error)
      << "a posture that inputs do not tell is known of known people alone";
  EXPECT_GT(training.strangers_step_accuracy, 0.5);

  // What is chosen is what did best on people left out, each person counting once.
  const auto best =
      std::min_element(selected.trials.begin(), selected.trials.begin() + 4,
                       [](const Trial& a, const Trial& b) { return a.error < b.error; });
  EXPECT_EQ(training.regularisation, best->regularisation);

  LearningTask nameless = task;
  for (Sequence& sequence : nameless.sequences) sequence.subject.clear();
  const Selected mixed = select_model(nameless, quick());
  EXPECT_EQ(mixed.subjects, 0);
  EXPECT_EQ(mixed.model.training.strangers_error, 0);
  EXPECT_LT(mixed.model.training.validated_error, training.strangers_error);
}

TEST(ModelSelection, people_with_one_take_each_are_all_strangers) {
  LearningTask task = task_of(4, 6, 4, 0.2, 5);
  for (std::size_t take = 0; take < 4; ++take) task.sequences[take].subject = std::to_string(take);
  const Selected selected = select_model(task, quick());
  EXPECT_GT(selected.model.training.strangers_error, 0);
  EXPECT_EQ(selected.model.training.validated_error, 0) << "nobody could be known";
}

TEST(ModelSelection, keeps_what_was_said) {
  SelectionOptions options = quick();
  options.regularisation = 42;
  options.rounds = 1;
  const Selected selected = select_model(task_of(4, 6, 4, 0.2, 5), options);
  EXPECT_EQ(selected.model.training.regularisation, 42);
  EXPECT_EQ(selected.model.training.regularisation_chosen_by, "given");
  EXPECT_TRUE(selected.trials.empty());
  EXPECT_GT(selected.model.training.validated_error, 0) << "validated all the same";
  EXPECT_EQ(selected.model.training.log_likelihood.size(), 1u);
}

TEST(ModelSelection, a_single_take_is_learnt_without_validation) {
  const Selected selected = select_model(task_of(1, 8, 4, 0.2, 6), quick());
  EXPECT_EQ(selected.folds, 0);
  EXPECT_EQ(selected.model.training.validated_error, 0);
  EXPECT_NE(selected.model.training.regularisation_chosen_by.find("single"), std::string::npos);
  SelectionOptions said = quick();
  said.regularisation = 7;
  EXPECT_EQ(select_model(task_of(1, 8, 4, 0.2, 6), said).model.training.regularisation_chosen_by,
            "given");
}

TEST(ModelSelection, where_nothing_can_be_held_out_the_defaults_stay) {
  // Each take has a label of its own: without it, that label is not known.
  LearningTask task = task_of(2, 6, 4, 0.2, 7);
  for (int take = 0; take < 2; ++take)
    for (Segment& segment : task.sequences[take].segments) segment.label = take;
  const Selected selected = select_model(task, quick());
  EXPECT_EQ(selected.model.training.regularisation, quick().learning.hmm.regularisation);
  EXPECT_EQ(selected.model.play.temper, PlayDefaults{}.temper);
  EXPECT_EQ(selected.model.training.validated_error, 0);
}

TEST(ModelSelection, reports_progress_that_never_goes_back) {
  SelectionOptions options = quick();
  double before = 0;
  std::set<std::string> said;
  options.learning.hmm.progress = [&](double share, const std::string& what) {
    EXPECT_GE(share, before) << what;
    EXPECT_LE(share, 1);
    before = share;
    said.insert(what);
  };
  select_model(task_of(4, 6, 4, 0.2, 8), options);
  EXPECT_EQ(before, 1);
  EXPECT_GE(said.size(), 4u);
}

TEST(ModelSelection, can_be_cancelled_at_every_stage) {
  for (const double when : {0.0, 0.3, 0.6, 0.9, 1.0}) {
    SelectionOptions options = quick();
    Cancel source;
    options.learning.hmm.cancel = source;
    options.learning.hmm.progress = [&](double share, const std::string&) {
      if (share >= when) source.request();
    };
    if (when == 0) source.request();
    if (when == 1) {
      EXPECT_NO_THROW(select_model(task_of(4, 6, 4, 0.2, 9), options)) << "it was done already";
      continue;
    }
    try {
      select_model(task_of(4, 6, 4, 0.2, 9), options);
      FAIL() << "not cancelled at " << when;
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), "cancelled");
    }
  }
}

}  // namespace
}  // namespace gait
