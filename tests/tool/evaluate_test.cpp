// gait evaluate: figures against the truth of walks the model has not seen.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "walking_takes.h"

namespace gait::testing {
namespace {

using nlohmann::json;

class Evaluate : public ::testing::Test {
 protected:
  void SetUp() override {
    write_takes(folder_ / "seen", 1, 3);
    write_takes(folder_ / "unseen", 4, 4);
    ASSERT_EQ(train_quickly({folder_ / "seen"}, folder_ / "m.gait").exit_code, 0);
  }
  json report(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"evaluate", folder_ / "m.gait", folder_ / "unseen",
                                       "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ToolRun run = run_tool(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return json::parse(run.out);
  }
  TestFolder folder_;
};

TEST_F(Evaluate, every_figure_is_there_over_clips_and_pooled) {
  const json all = report();
  EXPECT_EQ(all["clips"], 2);
  for (const char* key : {"step_accuracy", "style_accuracy", "path_ratio"}) {
    EXPECT_TRUE(all[key]["clips"].is_number()) << key;
    EXPECT_TRUE(all[key]["pooled"].is_number()) << key;
  }
  EXPECT_GT(all["step_accuracy"]["clips"], 0.85);
  EXPECT_GT(all["style_accuracy"]["pooled"], 0.9);
  EXPECT_EQ(all["style_accuracy_of_clips"], 1.0);
  const json& errors = all["output_error_deg"];
  EXPECT_GT(errors["mean_pose"]["clips"], errors["state_means"]["clips"]);
  EXPECT_GT(errors["state_means"]["clips"], errors["synthesised"]["clips"]);
  EXPECT_GT(errors["mapped"]["pooled"], 0.0);
  EXPECT_LT(all["jerk"]["synthesised"]["clips"], all["jerk"]["mapped"]["clips"]);
  EXPECT_NEAR(all["path_ratio"]["clips"], 1, 0.1);
  EXPECT_GT(all["foot_slide_mm"]["captured"]["clips"], 0.0);
  EXPECT_LE(all["frame_microseconds"]["p50"], all["frame_microseconds"]["p99"]);
  EXPECT_LE(all["frame_microseconds"]["p99"], all["frame_microseconds"]["max"]);
  EXPECT_EQ(all["delay"]["frames"], 0);
  EXPECT_EQ(all["by_joint"].size(), 7u);
  EXPECT_EQ(all["by_joint"]["Hips"]["counted"], false);
  EXPECT_EQ(all["by_style"].size(), 2u);
}

TEST_F(Evaluate, means_are_those_of_the_clips_and_joints_they_are_made_of) {
  const json all = report();
  double sum = 0, weighted = 0, frames = 0;
  for (const json& clip : all["by_clip"]) {
    const double error = clip["output_error_deg"]["mapped"];
    sum += error;
    weighted += error * clip["frames"].get<double>();
    frames += clip["frames"].get<double>();
  }
  const json& mapped = all["output_error_deg"]["mapped"];
  EXPECT_NEAR(mapped["clips"], sum / 2, 1e-9);
  EXPECT_NEAR(mapped["pooled"], weighted / frames, 1e-9);
  double joints = 0, counted = 0;
  for (const auto& [name, joint] : all["by_joint"].items())
    if (joint["counted"])
      joints += joint["output_error_deg"]["mapped"]["clips"].get<double>(), counted += 1;
  EXPECT_NEAR(mapped["clips"], joints / counted, 1e-9);
  double confused = 0;
  for (const json& row : all["style_confusion"]["frames"])
    for (const json& count : row) confused += count.get<double>();
  EXPECT_EQ(confused, frames) << "every frame of a known style is in the matrix once";
}

TEST_F(Evaluate, settings_change_what_they_say_they_do) {
  const json none = report({"--strength", "0"});
  EXPECT_NEAR(none["output_error_deg"]["mapped"]["clips"].get<double>(),
              none["output_error_deg"]["state_means"]["clips"].get<double>(), 1e-4)
      << "without mapping the state means are left";
  const json late = report({"--decoder", "lag", "--lag", "0.1", "--future", "4"});
  EXPECT_EQ(late["delay"]["frames"], 7);
  EXPECT_NEAR(late["delay"]["ms"], 7000 / 30.0, 1e-9);
  const json rough = report({"--past", "0"});
  EXPECT_EQ(rough["jerk"]["synthesised"], rough["jerk"]["mapped"])
      << "nothing to smooth over: what is mapped comes out";
  const json unset = report({}), all = report({"--past", "all"}), some = report({"--past", "20"});
  EXPECT_EQ(unset["output_error_deg"], all["output_error_deg"]) << "a model has no past of its own";
  EXPECT_NE(some["output_error_deg"], all["output_error_deg"]);
}

TEST_F(Evaluate, the_table_explains_its_figures) {
  const ToolRun run = run_tool({"evaluate", folder_ / "m.gait", folder_ / "unseen"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const std::string word : {"step accuracy", "share of frames", "error, synthesised",
                                 "foot slide", "By style", "By joint", "LeftUpLeg", "proud"})
    EXPECT_NE(run.out.find(word), std::string::npos) << word << " is not in\n" << run.out;
  EXPECT_EQ(run.err, "");
}

TEST_F(Evaluate, a_clip_with_too_few_steps_is_left_out_with_a_word) {
  write_take(folder_ / "unseen/walk_sad_9.bvh", "sad", 9, 1);
  const std::string labels = folder_ / "unseen/walk_sad_9.txt";
  write_file(labels, "0.1\t0.6\tright\n");
  const ToolRun run = run_tool({"evaluate", folder_ / "m.gait", folder_ / "unseen", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(json::parse(run.out)["clips"], 2);
  EXPECT_NE(run.err.find("walk_sad_9.bvh"), std::string::npos) << run.err;
  const ToolRun none =
      run_tool({"evaluate", folder_ / "m.gait", folder_ / "unseen/walk_sad_9.bvh"});
  EXPECT_EQ(none.exit_code, 1);
}

TEST_F(Evaluate, styles_the_model_does_not_know_are_not_judged) {
  write_take(folder_ / "walk_drunk_1.bvh", "drunk", 1);
  const ToolRun run =
      run_tool({"evaluate", folder_ / "m.gait", folder_ / "walk_drunk_1.bvh", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json all = json::parse(run.out);
  EXPECT_TRUE(all["style_accuracy"]["clips"].is_null());
  EXPECT_TRUE(all["style_calibration_error"].is_null());
  EXPECT_TRUE(all["output_error_deg"]["mapped"]["clips"].is_number());
}

}  // namespace
}  // namespace gait::testing
