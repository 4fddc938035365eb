// From sequences to a model, and from captured walks to sequences.
#include "gait/learn/trainer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gait/error.h"
#include "play/few_walks.h"

namespace gait {
namespace {

using testing::few_sequences;
using testing::few_walks;
using testing::plan_of;
using testing::walk_of;

LearningOptions with_states(int states) {
  LearningOptions options;
  options.states = states;
  options.hmm.threads = 1;
  return options;
}

TEST(Trainer, knows_how_long_steps_and_states_last) {
  const Learnt learnt = learn(walking_task(few_sequences()), with_states(4));
  const Model& model = learnt.model;
  ASSERT_EQ(model.labels.size(), 2u);
  for (int label = 0; label < 2; ++label) {
    std::vector<double> lengths;
    for (const ObservedSequence& sequence : learnt.observed.sequences)
      for (const Segment& segment : sequence.segments)
        if (segment.label == label) lengths.push_back((segment.end - segment.begin) / 30.0);
    double sum = 0;
    for (const double length : lengths) sum += length;
    EXPECT_NEAR(model.labels[label].duration, sum / static_cast<double>(lengths.size()), 1e-9);
    EXPECT_EQ(model.labels[label].shortest, *std::min_element(lengths.begin(), lengths.end()));
    EXPECT_EQ(model.labels[label].longest, *std::max_element(lengths.begin(), lengths.end()));
    double states = 0;
    for (const State& state : model.labels[label].states) {
      EXPECT_NEAR(state.duration, 1 / (1 - state.stay) / 30, 1e-12);
      states += state.duration;
    }
    // Each state is left once a step, but for the last step of a take.
    EXPECT_NEAR(states, model.labels[label].duration, 0.03);
  }
  EXPECT_EQ(model.input.lags, (std::vector<int>{1, 5, 10}));
  EXPECT_EQ(model.training.clips.size(), few_sequences().sequences.size());
}

TEST(Trainer, history_is_in_seconds_and_so_the_same_at_another_rate) {
  LearningTask task = walking_task(few_sequences());
  task.frame_rate = 60;  // the same numbers taken as twice as fast
  const Learnt learnt = learn(task, with_states(3));
  EXPECT_EQ(learnt.model.input.lags, (std::vector<int>{2, 10, 20}));
}

TEST(Trainer, states_hold_each_styles_mean) {
  const Learnt learnt = learn(walking_task(few_sequences()), with_states(3));
  const Model& model = learnt.model;
  ASSERT_EQ(model.styles.size(), 4u);
  for (int index = 0; index < learnt.table.total; ++index) {
    const State& state = model.labels[index / 3].states[index % 3];
    const StateStatistics& counted = learnt.states.statistics[index];
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(state.mean.size());
    for (int style = 0; style < 4; ++style)
      mean += counted.style_counts[style] / counted.count * state.style_means.col(style);
    EXPECT_TRUE(mean.isApprox(state.mean, 1e-9));
    EXPECT_EQ(state.style_covariance.rows(), model.input.size());
    // Taking each style's own mean out leaves less to scatter.
    EXPECT_LT(state.style_covariance.trace(),
              state.covariance.topLeftCorner(model.input.size(), model.input.size()).trace());
  }
}

TEST(Trainer, a_sensor_that_may_sit_otherwise_widens_poses_and_not_their_differences) {
  LearningOptions options = with_states(3);
  const Model exact = learn(walking_task(few_sequences()), options).model;
  options.placement = 0.02;
  const Model wide = learn(walking_task(few_sequences()), options).model;
  const int statics = exact.input.statics();
  for (std::size_t label = 0; label < exact.labels.size(); ++label)
    for (std::size_t k = 0; k < exact.labels[label].states.size(); ++k) {
      const State &before = exact.labels[label].states[k], &after = wide.labels[label].states[k];
      for (int i = 0; i < exact.input.size(); ++i) {
        const double deviation = exact.input_scaling.deviation[i],
                     added = i < statics ? std::pow(0.02 / deviation, 2) : 0;
        EXPECT_NEAR(after.covariance(i, i) - before.covariance(i, i), added, 1e-9 + 1e-9 * added);
        EXPECT_NEAR(after.style_covariance(i, i) - before.style_covariance(i, i), added,
                    1e-9 + 1e-9 * added);
      }
      EXPECT_LT((after.mean - before.mean).norm(), 1e-12);
    }
}

TEST(Trainer, needs_takes_of_every_label_and_a_state) {
  LearningTask task = walking_task(few_sequences());
  EXPECT_THROW(learn(task, with_states(0)), Error);
  task.labels.push_back({"jump", {0}});
  EXPECT_THROW(learn(task, with_states(2)), Error);
  task.sequences.clear();
  EXPECT_THROW(learn(task, with_states(2)), Error);
}

TEST(WalkSequences, see_upper_body_in_and_hips_and_legs_out) {
  const WalkSequences& walks = few_sequences();
  EXPECT_EQ(walks.styles, (std::vector<std::string>{"proud", "sad", "drunk", "in-a-hurry"}));
  EXPECT_EQ(walks.frame_rate, 30);
  ASSERT_EQ(walks.sequences.size(), 12u);
  for (const int joint : walks.body.output_joints) {
    const auto& inputs = walks.body.input_joints;
    EXPECT_EQ(std::count(inputs.begin(), inputs.end(), joint), 0);
  }
  EXPECT_EQ(walks.body.input_joints.size() + walks.body.output_joints.size(),
            walks.body.skeleton.joints.size());
  for (std::size_t i = 0; i < walks.sequences.size(); ++i) {
    const Sequence& sequence = walks.sequences[i];
    EXPECT_EQ(sequence.inputs.rows(), 3 * static_cast<int>(walks.body.input_joints.size()));
    EXPECT_EQ(sequence.segments.size(), 8u) << "four cycles";
    EXPECT_EQ(sequence.segments.front().label, 0);
    for (std::size_t k = 1; k < sequence.segments.size(); ++k) {
      EXPECT_EQ(sequence.segments[k].begin, sequence.segments[k - 1].end);
      EXPECT_NE(sequence.segments[k].label, sequence.segments[k - 1].label);
    }
    // Rotation vectors about the mean pose stay far from the half turn.
    EXPECT_LT(sequence.outputs.cwiseAbs().maxCoeff(), 2);
  }
}

TEST(WalkSequences, measured_hips_are_learnt_through_the_window_that_playing_has) {
  std::vector<Walk> walks;
  for (const char* style : {"in-a-hurry", "decided"})
    walks.push_back(walk_of(make_walk(plan_of(style, 1))));
  WalkOptions options;
  const Skeleton& skeleton = walks[0].clip.skeleton;
  const JointRoles roles = find_roles(skeleton);
  options.input_joints = {skeleton.joints[roles.hips].name,
                          skeleton.joints[roles.joint(Role::head)].name};
  for (const Leg* leg : {&roles.left, &roles.right})
    for (const int joint : {leg->thigh, leg->shank, leg->foot})
      options.output_joints.push_back(skeleton.joints[joint].name);
  const WalkSequences seen = walk_sequences(walks, options);
  EXPECT_LT(seen.body.heading_window, 1.05) << "these walk quickly";
  for (std::size_t i = 0; i < walks.size(); ++i) {
    const BodyPoses again = body_poses(walks[i].clip, seen.body,
                                       match_joints(seen.body, walks[i].clip.skeleton, "again"), 1);
    const Sequence expected = walk_sequence(seen.body, again, walks[i].contacts, "again");
    EXPECT_EQ(seen.sequences[i].inputs, expected.inputs);
  }
}

TEST(WalkSequences, says_what_was_used_and_why_not) {
  std::vector<Walk> walks{walk_of(make_walk(plan_of("sad", 1))),
                          walk_of(make_walk(plan_of("sad", 2), 120)),
                          walk_of(make_walk(plan_of("sad", 3)))};
  walks[2].contacts.resize(3);
  const WalkSequences seen = walk_sequences(walks, {});
  ASSERT_EQ(seen.uses.size(), 3u);
  EXPECT_TRUE(seen.uses[0].used);
  EXPECT_TRUE(seen.uses[0].remark.empty());
  EXPECT_EQ(seen.uses[0].steps, 8);
  EXPECT_NE(seen.uses[1].remark.find("from 120 to 30"), std::string::npos);
  EXPECT_FALSE(seen.uses[2].used);
  EXPECT_NE(seen.uses[2].why_not.find("found 2"), std::string::npos);
  EXPECT_EQ(seen.walk_of_sequence, (std::vector<int>{0, 1}));
  // The resampled walk has its steps where the other rate had them.
  EXPECT_NEAR(seen.sequences[1].segments[0].begin, walks[1].contacts[0].frame / 4.0, 0.51);
}

TEST(WalkSequences, with_wrong_words_is_an_error_that_names_them) {
  const std::vector<Walk> walks{walk_of(make_walk(plan_of("sad", 1)))};
  const auto message = [](const std::vector<Walk>& from, const WalkOptions& options) {
    try {
      walk_sequences(from, options);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  WalkOptions options;
  options.input_joints = {"Tail"};
  EXPECT_NE(message(walks, options).find("Tail"), std::string::npos);
  const std::string foot =
      walks[0].clip.skeleton.joints[find_roles(walks[0].clip.skeleton).left.foot].name;
  options.input_joints = {foot};
  EXPECT_NE(message(walks, options).find(foot), std::string::npos);
  EXPECT_NE(message({}, {}).find("at least one walk"), std::string::npos);
  options = {};
  options.fewest_steps = 100;
  EXPECT_NE(message(walks, options).find("100 steps"), std::string::npos);

  std::vector<Walk> beyond = walks;
  beyond[0].contacts.back().frame = beyond[0].clip.frames() + 7;
  EXPECT_NE(message(beyond, {}).find("within the clip"), std::string::npos);
  beyond = walks;
  std::swap(beyond[0].contacts[0], beyond[0].contacts[2]);
  EXPECT_NE(message(beyond, {}).find("one after the other"), std::string::npos);

  std::vector<Walk> other{walks[0], walks[0]};
  other[1].clip.skeleton.joints[find_roles(walks[0].clip.skeleton).left.shank].name = "Stilt";
  EXPECT_NE(message(other, {}), "no error");
}

}  // namespace
}  // namespace gait
