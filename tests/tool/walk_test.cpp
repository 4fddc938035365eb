// gait walk: walks at speeds out of nothing; gait render of speeds; gait corpus --speeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "gait/files/bvh.h"
#include "gait/motion/joint_roles.h"
#include "tool_runner.h"
#include "walking_models.h"

namespace gait::testing {
namespace {

Clip walked(const std::string& path, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"walk", speed_model(), "-o", path});
  const ToolRun run = run_tool(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return clip_from_bvh(read_bvh(path));
}

double way(const Clip& clip) {
  return (clip.translation(clip.frames() - 1)[0] - clip.translation(0)[0]).z();
}

TEST(Walk, goes_as_far_as_its_speed_says_on_any_legs) {
  const TestFolder folder;
  // The feet's law is exact to 1 % over whole cycles; ten seconds need not be whole ones.
  EXPECT_NEAR(way(walked(folder / "a.bvh", {"--speed", "1.4", "--seconds", "10"})), 14, 0.42);
  EXPECT_NEAR(way(walked(folder / "b.bvh", {"--speed", "3.6km/h", "--seconds", "10"})), 10, 0.3);
  const Clip small =
      walked(folder / "c.bvh", {"--speed", "1.2", "--leg", "0.6", "--seconds", "10"});
  EXPECT_NEAR(way(small), 12, 0.36);
  const JointRoles roles = find_roles(small.skeleton);
  const auto& joints = small.skeleton.joints;
  EXPECT_NEAR(joints[roles.left.shank].offset.norm() + joints[roles.left.foot].offset.norm(), 0.6,
              1e-4);
}

TEST(Walk, starts_from_standing_and_comes_to_its_speed) {
  const TestFolder folder;
  const Clip clip = walked(folder / "a.bvh", {"--speed", "0:7km/h", "--seconds", "12"});
  const auto at = [&](double seconds) {
    return clip.translation(static_cast<int>(seconds * clip.frame_rate))[0].z();
  };
  EXPECT_NEAR(at(1), 0, 0.02);
  EXPECT_NEAR(at(12) - at(11), 7 / 3.6, 0.25);
}

TEST(Walk, the_same_words_write_the_same_file) {
  const TestFolder folder;
  walked(folder / "a.bvh", {"--speed", "0.5:1.5", "--seconds", "5", "--turn", "-10"});
  walked(folder / "b.bvh", {"--speed", "0.5:1.5", "--seconds", "5", "--turn", "-10"});
  EXPECT_EQ(bytes_of(folder / "a.bvh"), bytes_of(folder / "b.bvh"));
}

TEST(Walk, speeds_beyond_walking_are_clamped_with_a_word) {
  const TestFolder folder;
  const auto said = [&](const std::string& speed, const std::string& leg) {
    const ToolRun run = run_tool({"walk", speed_model(), "--speed", speed, "--leg", leg,
                                  "--seconds", "2", "-o", folder / "x.bvh"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.err;
  };
  EXPECT_EQ(said("10km/h", "0.83"), "");
  const std::string fast = said("12km/h", "0.83");
  EXPECT_NE(fast.find("12 km/h is clamped to 10 km/h"), std::string::npos) << fast;
  const std::string backwards = said("-1", "0.83");
  EXPECT_NE(backwards.find("clamped to 0 km/h"), std::string::npos) << backwards;
  const std::string small = said("10km/h", "0.6");
  EXPECT_NE(small.find("the most for a leg of 0.6 m"), std::string::npos) << small;
  EXPECT_NE(said("1", "9").find("a leg of 9 m is clamped"), std::string::npos);
}

TEST(Walk, what_cannot_be_walked_is_refused_with_what_can) {
  const TestFolder folder;
  const auto error = [&](std::vector<std::string> arguments, int exit_code) {
    arguments.insert(arguments.begin(), "walk");
    arguments.insert(arguments.end(), {"--seconds", "2", "-o", folder / "x.bvh"});
    const ToolRun run = run_tool(arguments);
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    EXPECT_EQ(lines_of(run.err), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "x.bvh"));
    return run.err;
  };
  const std::string unknown = error({speed_model(), "--speed", "1", "--subject", "Bob"}, 1);
  EXPECT_NE(unknown.find("'Bob'; it has neutral"), std::string::npos) << unknown;
  const std::string untaught = error({styled_model(), "--speed", "1"}, 1);
  EXPECT_NE(untaught.find("speed walker"), std::string::npos) << untaught;
  EXPECT_NE(untaught.find("train"), std::string::npos) << untaught;
  for (const std::string speed : {"fast", "nan", "1:2:3", "1:", "inf", "4mph"})
    error({speed_model(), "--speed", speed}, 2);
  error({speed_model(), "--speed", "1", "--law", "moon"}, 2);
}

TEST(Render, a_page_of_speeds_and_legs_says_each_of_them) {
  const TestFolder folder;
  const std::vector<std::string> arguments{"render", speed_model(), "--speeds", "0,2,6km/h",
                                           "--legs", "0.7,0.95",    "-o",       folder / "a.png"};
  const ToolRun run = run_tool(arguments);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(bytes_of(folder / "a.png").substr(1, 3), "PNG");
  EXPECT_EQ(run_tool({"render", speed_model(), "--legs", "0.7", "-o", folder / "b.png"}).exit_code,
            2);
  EXPECT_EQ(
      run_tool({"render", speed_model(), "--speeds", "1", "--legs", "-1", "-o", folder / "b.png"})
          .exit_code,
      2);
}

TEST(Corpus, walks_over_speed_are_written_on_request_only) {
  const TestFolder folder;
  ASSERT_EQ(run_tool({"corpus", folder / "plain"}).exit_code, 0);
  const ToolRun run = run_tool({"corpus", folder / "speeds", "--speeds", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const std::string speed : {"0.6", "1.4", "2.0"}) {
    const std::string name = "/walk_neutral_" + speed + ".bvh";
    EXPECT_FALSE(std::filesystem::exists(folder.path() + "/plain" + name));
    const Clip clip = clip_from_bvh(read_bvh(folder.path() + "/speeds" + name));
    const double seconds = (clip.frames() - 1) / clip.frame_rate;
    EXPECT_NEAR(way(clip) / seconds / std::stod(speed), 1, 0.06) << speed;
  }
}

TEST(Info, tells_how_few_components_carry_a_walk_and_how_often_one_steps) {
  const ToolRun run = run_tool({"info", walking_model(), "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto spaces = nlohmann::json::parse(run.out)["spaces"];
  EXPECT_EQ(spaces["styles"]["frames"], 40);
  EXPECT_EQ(spaces["styles"]["values"], 40 * 3 * 18);
  ASSERT_EQ(spaces["speeds"].size(), 1u);
  const auto& subject = spaces["speeds"][0];
  EXPECT_EQ(subject["subject"], "neutral");
  // Made with 0.7516 V^0.4077 (mean_gait.h), steps varying by 2 %.
  EXPECT_NEAR(subject["frequency_scale"].get<double>(), 0.7516, 0.03);
  EXPECT_NEAR(subject["frequency_power"].get<double>(), 0.4077, 0.03);
  ASSERT_EQ(subject["carried"].size(), 4u);
  int before = 0;
  for (const auto& carried : subject["carried"]) {
    EXPECT_GE(carried["components"].get<int>(), std::max(1, before));
    before = carried["components"];
    EXPECT_NEAR(carried["reduction"].get<double>() * before, subject["cycles"].get<double>(), 1e-9);
  }
  const ToolRun text = run_tool({"info", styled_model()});
  EXPECT_NE(text.out.find("at any speed: no"), std::string::npos) << text.out;
}

}  // namespace
}  // namespace gait::testing
