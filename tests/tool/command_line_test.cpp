// What the program says and how it ends, for right and wrong use alike.
#include <gtest/gtest.h>

#include "sample_clips.h"
#include "tool_runner.h"

namespace gait::testing {
namespace {

void expect_used_wrongly(const std::vector<std::string>& arguments, const std::string& says) {
  const ToolRun run = run_tool(arguments);
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("--help"), std::string::npos) << "no hint: " << run.err;
  EXPECT_EQ(lines_of(run.err), 1) << run.err;
  EXPECT_EQ(run.out, "");
}

void expect_failed(const std::vector<std::string>& arguments, const std::string& says) {
  const ToolRun run = run_tool(arguments);
  EXPECT_EQ(run.exit_code, 1) << run.err;
  const std::string who = "gait " + arguments.front() + ": ";
  EXPECT_EQ(run.err.substr(0, who.size()), who);
  EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
  EXPECT_EQ(lines_of(run.err), 1) << run.err;
}

TEST(CommandLine, help_names_every_subcommand_and_each_explains_itself_with_examples) {
  const ToolRun program = run_tool({"--help"});
  EXPECT_EQ(program.exit_code, 0);
  EXPECT_EQ(program.err, "");
  for (const std::string name : {"corpus", "label", "render"}) {
    EXPECT_NE(program.out.find("\n  " + name + " "), std::string::npos) << name;
    const ToolRun help = run_tool({name, "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.out.find("Examples:\n  gait " + name), std::string::npos) << help.out;
  }
}

TEST(CommandLine, version_is_one_line) {
  const ToolRun run = run_tool({"--version"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.out.substr(0, 5), "gait ");
  EXPECT_EQ(lines_of(run.out), 1);
}

TEST(CommandLine, wrong_use_ends_with_two_and_one_line_with_a_hint) {
  expect_used_wrongly({}, "no subcommand");
  expect_used_wrongly({"dance"}, "no subcommand 'dance'");
  expect_used_wrongly({"--loud"}, "no option '--loud'");
  expect_used_wrongly({"render"}, "CLIP");
  expect_used_wrongly({"render", "walk.bvh"}, "--output");
  expect_used_wrongly({"render", "--storbe", "3", "walk.bvh", "-o", "a.png"}, "'--storbe'");
  expect_used_wrongly({"render", "walk.bvh", "-o", "a.jpg"}, ".png");
  expect_used_wrongly({"render", "walk.bvh", "-o", "a.png", "--strobe", "0"}, "--strobe");
  expect_used_wrongly({"render", "walk.bvh", "-o", "a.png", "--strobe", "many"}, "--strobe");
  expect_used_wrongly({"render", "walk.bvh", "-o", "a.png", "--view", "above"}, "'above'");
  expect_used_wrongly({"render", "walk.bvh", "-o", "a.png", "--unit", "furlong"}, "furlong");
  expect_used_wrongly({"render", "walk.bvh", "-o", "a.png", "--up", "w"}, "--up");
  expect_used_wrongly({"render", "a.bvh", "b.bvh", "-o", "a.png", "--compare", "c.bvh"},
                      "--compare");
  expect_used_wrongly({"label", "a.bvh", "b.bvh", "-o", "labels.txt"}, "folder");
  expect_used_wrongly({"corpus"}, "DIR");
  expect_used_wrongly({"corpus", "somewhere", "--seed", "-3"}, "'-3'");
}

TEST(CommandLine, what_cannot_be_read_ends_with_one_and_names_the_file) {
  const TestFolder folder;
  write_file(folder / "empty.bvh", "");
  write_file(folder / "letter.bvh", "Dear Sir or Madam,\n");
  std::string crane = arm_of_a_crane(5);
  write_file(folder / "cut.bvh", crane.substr(0, crane.find("MOTION")));
  const std::string picture = folder / "a.png";
  expect_failed({"render", folder / "none.bvh", "-o", picture}, folder / "none.bvh");
  expect_failed({"render", folder.path(), "-o", picture}, folder.path());
  expect_failed({"render", folder / "empty.bvh", "-o", picture}, folder / "empty.bvh");
  expect_failed({"render", folder / "letter.bvh", "-o", picture}, folder / "letter.bvh");
  expect_failed({"render", folder / "cut.bvh", "-o", picture}, folder / "cut.bvh");
  expect_failed({"label", folder / "letter.bvh"}, folder / "letter.bvh");
  EXPECT_FALSE(std::filesystem::exists(picture));
}

TEST(CommandLine, what_cannot_be_written_ends_with_one_and_leaves_nothing_behind) {
  const TestFolder folder;
  write_walk(folder / "walk.bvh");
  write_file(folder / "file", "");
  for (const std::string ending : {".png", ".svg", ".mp4"})
    expect_failed({"render", folder / "walk.bvh", "-o", folder / "no/such/folder/a" + ending},
                  "no/such/folder");
  expect_failed({"label", folder / "walk.bvh", "-o", folder / "no/such/folder/a.txt"},
                "no/such/folder");
  expect_failed({"corpus", folder / "file/below"}, folder / "file/below");
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_TRUE(entry.path().filename() == "walk.bvh" || entry.path().filename() == "file")
        << entry.path();
}

}  // namespace
}  // namespace gait::testing
