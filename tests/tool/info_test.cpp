// gait info: what a model says of itself.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "gait/model/model_file.h"
#include "walking_takes.h"

namespace gait::testing {
namespace {

using nlohmann::json;

TEST(Info, tells_what_training_put_in) {
  const TestFolder folder;
  write_takes(folder / "walks", 1, 2);
  ASSERT_EQ(
      train_quickly({folder / "walks"}, folder / "m.gait", {"--comment", "two moods"}).exit_code,
      0);
  const Model model = read_model(folder / "m.gait");
  const ToolRun run = run_tool({"info", folder / "m.gait", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json report = json::parse(run.out);
  EXPECT_EQ(report["name"], "m");
  EXPECT_EQ(report["synthetic"], false);
  EXPECT_EQ(report["comment"], "two moods");
  EXPECT_EQ(report["frame_rate"], 30.0);
  EXPECT_EQ(report["styles"], json({"proud", "sad"}));
  ASSERT_EQ(report["labels"].size(), 2u);
  EXPECT_EQ(report["labels"][0]["name"], "right");
  EXPECT_EQ(report["labels"][0]["successors"], json({"left"}));
  EXPECT_EQ(report["labels"][0]["states"].size(), 3u);
  EXPECT_NEAR(report["labels"][1]["seconds"], model.labels[1].duration, 1e-12);
  EXPECT_EQ(report["inputs"]["streams"].size(), model.inputs.size());
  EXPECT_EQ(report["outputs"]["streams"][0]["name"], "Hips");
  EXPECT_EQ(report["outputs"]["streams"][0]["kind"], "rotation");
  double squares = 0;
  for (int value = 0; value < 3; ++value)
    squares += std::pow(model.output_scaling.deviation[value], 2);
  EXPECT_EQ(report["outputs"]["streams"][0]["moving"], 3);
  EXPECT_NEAR(report["outputs"]["streams"][0]["deviation"],
              180 / std::numbers::pi * std::sqrt(squares), 1e-9);
  ASSERT_EQ(report["hinges"].size(), 4u);  // right knee first
  EXPECT_EQ(report["hinges"][0]["joint"], "RightLeg");
  EXPECT_NEAR(report["hinges"][0]["most_degrees"],
              180 / std::numbers::pi * model.body->hinges[0].most, 1e-9);
  EXPECT_EQ(report["spaces"]["steps"], true);
  EXPECT_EQ(report["play"]["decoder"], "viterbi");
  EXPECT_GT(report["play"]["usual_distance"], 0);
  EXPECT_EQ(report["training"]["regularisation_chosen_by"], "given");
  EXPECT_EQ(report["training"]["clips"].size(), 4u);

  const ToolRun text = run_tool({"info", folder / "m.gait"});
  ASSERT_EQ(text.exit_code, 0) << text.err;
  for (const std::string word :
       {"two moods", "right", "left", "proud, sad", "Hips", "viterbi", "walk_sad_2.bvh"})
    EXPECT_NE(text.out.find(word), std::string::npos) << word << " is not in\n" << text.out;
  EXPECT_EQ(text.out.find("SYNTHETIC"), std::string::npos);
}

TEST(Info, the_built_in_model_is_there_by_name_and_says_that_it_is_synthetic) {
  const ToolRun text = run_tool({"info", "gait-demo"});
  ASSERT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("SYNTHETIC"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("in-a-hurry"), std::string::npos) << text.out;
}

TEST(Info, what_is_no_model_ends_with_one_and_is_named) {
  const TestFolder folder;
  write_file(folder / "junk.gait", "HIERARCHY");
  for (const std::string name : {"junk.gait", "missing.gait"}) {
    const ToolRun run = run_tool({"info", folder / name});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find(folder / name), std::string::npos) << run.err;
    EXPECT_EQ(lines_of(run.err), 1) << run.err;
  }
  EXPECT_EQ(run_tool({"info"}).exit_code, 2);
}

}  // namespace
}  // namespace gait::testing
