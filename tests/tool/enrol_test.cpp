// gait enrol: a person merged into a model, and what is refused.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "walking_takes.h"

namespace gait::testing {
namespace {

class Enrol : public ::testing::Test {
 protected:
  void SetUp() override {
    write_takes(folder_ / "seen", 1, 2);
    write_take(folder_ / "anna.bvh", "drunk", 1);
    ASSERT_EQ(train_quickly({folder_ / "seen"}, folder_ / "m.gait").exit_code, 0);
  }
  TestFolder folder_;
};

TEST_F(Enrol, writes_a_model_that_knows_the_person_and_leaves_the_first_as_it_was) {
  const std::string before = bytes_of(folder_ / "m.gait");
  const ToolRun run = run_tool({"enrol", folder_ / "m.gait", folder_ / "anna.bvh", "--label",
                                "{subject}.bvh", "-o", folder_ / "anna.gait", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json report = nlohmann::json::parse(run.out);
  EXPECT_GE(report["cycles"], 2);
  EXPECT_LT(report["error_expected_deg"], report["error_before_deg"]);
  EXPECT_EQ(bytes_of(folder_ / "m.gait"), before);
  const ToolRun judged = run_tool({"evaluate", folder_ / "anna.gait", folder_ / "anna.bvh",
                                   "--label", "{subject}.bvh", "--json"});
  ASSERT_EQ(judged.exit_code, 0) << judged.err;
  EXPECT_EQ(nlohmann::json::parse(judged.out)["by_clip"][0]["subject_in_training"], true);
  const ToolRun stranger = run_tool(
      {"evaluate", folder_ / "m.gait", folder_ / "anna.bvh", "--label", "{subject}.bvh", "--json"});
  EXPECT_EQ(nlohmann::json::parse(stranger.out)["by_clip"][0]["subject_in_training"], false);
}

TEST_F(Enrol, refuses_two_people_and_writes_nothing) {
  write_take(folder_ / "bert.bvh", "drunk", 2);
  const ToolRun run =
      run_tool({"enrol", folder_ / "m.gait", folder_ / "anna.bvh", folder_ / "bert.bvh", "--label",
                "{subject}.bvh", "-o", folder_ / "both.gait"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(lines_of(run.err), 1) << run.err;
  EXPECT_NE(run.err.find("one person"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "both.gait"));
}

}  // namespace
}  // namespace gait::testing
