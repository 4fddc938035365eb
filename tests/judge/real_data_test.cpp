// What the whole chain reaches on real captured walks, with the bounds the project has set itself.
// Known figures of other methods on the same clips are beside the bounds.
#include <gtest/gtest.h>

#include <numbers>

#include "gait/judge/evaluation.h"
#include "gait/teach/walk_model.h"
#include "judge/real_walks.h"
#include "shared_data.h"

namespace gait::testing {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

Evaluation learn_and_judge(const std::vector<Walk>& seen, const std::vector<Walk>& unseen,
                           const SelectionOptions& options = {}) {
  Selected selected = select_walk_model(walk_sequences(seen, {}), options);
  return evaluate(std::make_shared<const Model>(std::move(selected.model)), unseen, {});
}

double error(const Evaluation& judged, Estimate estimate) {
  return judged.error(estimate).over_clips * degrees;
}

void record(const Evaluation& judged) {
  const auto note = [](const char* name, double value) {
    ::testing::Test::RecordProperty(name, std::to_string(value));
    std::printf("  %-20s %.4f\n", name, value);
  };
  note("step_accuracy", judged.step_accuracy().over_clips);
  note("step_accuracy_pooled", judged.step_accuracy().pooled);
  note("style_accuracy", judged.style_accuracy().over_clips);
  for (const Estimate estimate : estimates)
    note(("error_" + std::string(estimate_name(estimate))).c_str(), error(judged, estimate));
  note("path_ratio", judged.path_ratio().over_clips);
}

bool learnt_from(const std::string& name) { return bandai_take(name) <= 5; }
bool judged_on(const std::string& name) { return bandai_take(name) > 5; }

TEST(RealDataSlow, five_states_recognise_steps_and_styles_and_each_stage_comes_closer) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-2");
  SelectionOptions options;
  options.learning.states = 5;
  options.regularisation = 30;
  options.rounds = 0;
  const Evaluation judged =
      learn_and_judge(real_walks("bandai-namco-2", learnt_from, bandai_style),
                      real_walks("bandai-namco-2", judged_on, bandai_style), options);
  record(judged);
  EXPECT_GE(judged.step_accuracy().over_clips, 0.955);
  EXPECT_GE(judged.step_accuracy().pooled, 0.95);
  EXPECT_GE(judged.style_accuracy().over_clips, 0.97);
  EXPECT_GT(error(judged, Estimate::mean_pose), error(judged, Estimate::state_means));
  EXPECT_GT(error(judged, Estimate::state_means), error(judged, Estimate::mapped));
  EXPECT_GT(error(judged, Estimate::mapped), error(judged, Estimate::synthesised));
  EXPECT_LE(error(judged, Estimate::synthesised), 3.95)
      << "nearest neighbours with history: 4.56, ridge regression with history: 5.01";
}

TEST(RealDataSlow, the_default_is_closer_still_and_half_as_jerky_as_the_mapping) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-2");
  const Evaluation judged = learn_and_judge(real_walks("bandai-namco-2", learnt_from, bandai_style),
                                            real_walks("bandai-namco-2", judged_on, bandai_style));
  record(judged);
  EXPECT_LE(error(judged, Estimate::synthesised), 3.65);
  EXPECT_LE(error(judged, Estimate::synthesised), error(judged, Estimate::mapped) + 0.05);
  EXPECT_LE(judged.jerk(Source::synthesised).over_clips,
            0.51 * judged.jerk(Source::mapped).over_clips);
  EXPECT_LE(judged.jerk(Source::synthesised).over_clips,
            1.0 * judged.jerk(Source::truth).over_clips);
  EXPECT_GE(judged.jerk(Source::synthesised).over_clips,
            0.7 * judged.jerk(Source::truth).over_clips);
  EXPECT_EQ(judged.delay_frames, 0) << "no look-ahead";
}

TEST(RealDataSlow, another_take_by_another_actor_is_found_from_one_example_per_style) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-1");
  const Evaluation judged = learn_and_judge(
      real_walks(
          "bandai-namco-1", [](const std::string& name) { return bandai_take(name) == 1; },
          bandai_style),
      real_walks(
          "bandai-namco-1", [](const std::string& name) { return bandai_take(name) == 2; },
          bandai_style));
  record(judged);
  EXPECT_LE(error(judged, Estimate::synthesised), 7.1)
      << "nearest neighbours with history: 8.9, ridge regression: 10.3, mean pose: 13.3";
}

TEST(RealDataSlow, two_strangers_are_found_from_eight_walkers_and_their_feet_carry_them) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  std::vector<std::string> subjects;
  const auto subject_of = [](const std::string& name) { return name.substr(0, name.find('_')); };
  for (const Walk& walk : real_walks("cmu-walks", [](const std::string&) { return true; })) {
    const std::string subject = subject_of(std::filesystem::path(walk.clip.name).filename());
    if (subjects.empty() || subjects.back() != subject) subjects.push_back(subject);
  }
  ASSERT_EQ(subjects.size(), 10u);
  const auto is_stranger = [&](const std::string& name) {
    return subject_of(name) == subjects[8] || subject_of(name) == subjects[9];
  };
  std::vector<Walk> known =
      real_walks("cmu-walks", [&](const std::string& name) { return !is_stranger(name); });
  for (Walk& walk : known)
    walk.subject = subject_of(std::filesystem::path(walk.clip.name).filename());
  const Evaluation judged = learn_and_judge(known, real_walks("cmu-walks", is_stranger));
  record(judged);
  EXPECT_LE(error(judged, Estimate::synthesised), 9.3);
  EXPECT_LT(error(judged, Estimate::synthesised), error(judged, Estimate::state_means));
  EXPECT_LT(error(judged, Estimate::synthesised), error(judged, Estimate::mean_pose));
  EXPECT_GT(judged.step_accuracy().over_clips, 0.85);
}

}  // namespace
}  // namespace gait::testing
