// gait synth: walks in styles out of nothing.
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "gait/files/bvh.h"
#include "gait/motion/contacts.h"
#include "gait/motion/joint_roles.h"
#include "tool_runner.h"
#include "walking_models.h"

namespace gait::testing {
namespace {

WalkTrack followed(const Clip& clip) { return follow_walk(clip, find_roles(clip.skeleton)); }

TEST(Synth, walks_as_many_cycles_as_were_asked_for) {
  const TestFolder folder;
  for (const std::string engine : {"style", "step"}) {
    const ToolRun run = run_tool({"synth", walking_model(), "--style", "proud", "--engine", engine,
                                  "--cycles", "6", "-o", folder / "walk.bvh"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const Clip clip = clip_from_bvh(read_bvh(folder / "walk.bvh"));
    const WalkTrack track = followed(clip);
    // From right contact to right contact, of which the ends are not seen from both sides.
    EXPECT_NEAR((clip.frames() - 1) / clip.frame_rate / track.cycle_seconds, 6, 0.4) << engine;
    EXPECT_GT(track.speed, 0.5) << engine;
    EXPECT_NEAR(clip.translation(0)[0].x(), 0, 1e-6);
    EXPECT_NEAR(clip.translation(0)[0].z(), 0, 1e-6);
  }
}

TEST(Synth, the_same_seed_writes_the_same_file_and_another_seed_another_walk) {
  const TestFolder folder;
  const auto walked = [&](const std::string& seed, const std::string& name) {
    const ToolRun run = run_tool({"synth", walking_model(), "--mix", "proud=0.7,sad=0.3",
                                  "--seconds", "4", "--seed", seed, "-o", folder / name});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return bytes_of(folder / name);
  };
  const std::string once = walked("7", "once.bvh");
  EXPECT_EQ(once, walked("7", "again.bvh"));
  EXPECT_NE(once, walked("8", "other.bvh"));
}

TEST(Synth, a_change_of_style_on_the_way_is_seen_after_it_and_not_before) {
  const TestFolder folder;
  const std::vector<std::string> plain{
      "synth", walking_model(), "--style", "proud", "--seconds", "8", "-o", folder / "proud.bvh"};
  std::vector<std::string> changing = plain;
  changing.back() = folder / "change.bvh";
  changing.insert(changing.end(), {"--then", "sad@4"});
  ASSERT_EQ(run_tool(plain).exit_code, 0);
  const ToolRun run = run_tool(changing);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Clip proud = clip_from_bvh(read_bvh(folder / "proud.bvh"));
  const Clip change = clip_from_bvh(read_bvh(folder / "change.bvh"));
  ASSERT_EQ(proud.frames(), change.frames());
  const int changed = static_cast<int>(4 * proud.frame_rate);
  for (int frame = 0; frame < changed; ++frame)
    EXPECT_EQ(proud.translation(frame)[0], change.translation(frame)[0]) << frame;
  // Who is sad is slower.
  const auto way = [&](const Clip& clip) {
    return (clip.translation(clip.frames() - 1)[0] - clip.translation(changed)[0]).norm();
  };
  EXPECT_LT(way(change), 0.85 * way(proud));
}

TEST(Synth, turns_as_fast_as_it_was_told) {
  const TestFolder folder;
  const ToolRun run = run_tool({"synth", walking_model(), "--style", "proud", "--seconds", "9",
                                "--turn", "20", "-o", folder / "turn.bvh"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Clip clip = clip_from_bvh(read_bvh(folder / "turn.bvh"));
  const WalkTrack track = followed(clip);
  const auto at = [&](double seconds) {
    return track.heading[static_cast<std::size_t>(seconds * clip.frame_rate)];
  };
  EXPECT_NEAR((at(7) - at(2)) * 180 / std::numbers::pi, 100, 8);
}

TEST(Synth, what_cannot_be_walked_is_refused_with_what_can) {
  const TestFolder folder;
  const auto error = [&](std::vector<std::string> arguments, int exit_code) {
    arguments.insert(arguments.begin(), "synth");
    arguments.insert(arguments.end(), {"-o", folder / "x.bvh"});
    const ToolRun run = run_tool(arguments);
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    EXPECT_EQ(lines_of(run.err), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "x.bvh"));
    return run.err;
  };
  const std::string model = walking_model();
  const std::string unknown = error({model, "--style", "glad", "--cycles", "2"}, 1);
  EXPECT_NE(unknown.find("'glad'"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("proud, sad"), std::string::npos) << unknown;
  EXPECT_NE(error({model, "--mix", "proud=1,sad=-1", "--cycles", "2"}, 1).find("negative"),
            std::string::npos);
  EXPECT_NE(error({model, "--mix", "proud=0,sad=0", "--cycles", "2"}, 1).find("above 0"),
            std::string::npos);
  EXPECT_NE(error({model, "--mix", "proud=much", "--cycles", "2"}, 2).find("'proud=much'"),
            std::string::npos);
  EXPECT_NE(error({model, "--style", "proud", "--then", "sad", "--cycles", "2"}, 2).find("@"),
            std::string::npos);
  EXPECT_NE(error({model, "--style", "proud"}, 2).find("--cycles"), std::string::npos);
  EXPECT_NE(error({model, "--cycles", "2"}, 2).find("--style"), std::string::npos);
  error({model, "--style", "proud", "--seconds", "nan"}, 2);
  error({model, "--style", "proud", "--cycles", "2", "--variation", "3"}, 2);
  const std::string untaught = error({speed_model(), "--style", "proud", "--cycles", "2"}, 1);
  EXPECT_NE(untaught.find("style walker"), std::string::npos) << untaught;
  EXPECT_NE(untaught.find("train"), std::string::npos) << untaught;
}

}  // namespace
}  // namespace gait::testing
