// --roles: what a user says of joints whose names say nothing.
#include <gtest/gtest.h>

#include "sample_clips.h"
#include "walking_takes.h"

namespace gait::testing {
namespace {

TEST(Roles, a_name_that_no_clip_has_is_told_once_and_the_others_count) {
  const TestFolder folder;
  write_takes(folder / "walks", 1, 2);
  write_file(folder / "roles.txt", "Hips = hips\nLeftWing = left arm\n");
  const ToolRun train =
      train_quickly({folder / "walks"}, folder / "m.gait", {"--roles", folder / "roles.txt"});
  EXPECT_EQ(train.exit_code, 0) << train.err;
  const std::size_t told = train.err.find("LeftWing");
  ASSERT_NE(told, std::string::npos) << train.err;
  EXPECT_EQ(train.err.find("LeftWing", told + 1), std::string::npos) << "of four clips, once";
  EXPECT_EQ(train.err.find("Hips"), std::string::npos) << train.err;

  write_walk(folder / "one.bvh");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"label", folder / "one.bvh"},
        {"render", folder / "one.bvh", "-o", folder / "one.png"}}) {
    std::vector<std::string> words = command;
    words.insert(words.end(), {"--roles", folder / "roles.txt"});
    const ToolRun run = run_tool(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.err.find("LeftWing"), std::string::npos) << command[0] << ": " << run.err;
  }
}

}  // namespace
}  // namespace gait::testing
