// gait corpus and gait label: walks and their steps as files.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "gait/files/bvh.h"
#include "gait/files/label_file.h"
#include "gait/motion/contacts.h"
#include "gait/motion/joint_roles.h"
#include "sample_clips.h"
#include "tool_runner.h"

namespace gait::testing {
namespace {

TEST(Corpus, every_walk_comes_with_its_labels_and_the_report_counts_them) {
  const TestFolder folder;
  const ToolRun run = run_tool({"corpus", folder / "walks", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const auto report = nlohmann::json::parse(run.out);
  EXPECT_NE(report["notice"].get<std::string>().find("synthetic"), std::string::npos);
  EXPECT_EQ(report["styles"].size(), 11u);

  std::map<std::string, int> clips, cycles;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "walks")) {
    if (entry.path().extension() != ".bvh") continue;
    const std::string name = entry.path().stem().string();  // walk_STYLE_TAKE
    const std::string style = name.substr(5, name.rfind('_') - 5);
    const BvhFile bvh = read_bvh(entry.path());
    const LabelFile labels =
        read_labels(std::filesystem::path(entry.path()).replace_extension(".txt"));
    ++clips[style];
    cycles[style] += static_cast<int>(
        cycles_between(contacts_from_labels(labels.segments, 1 / bvh.frame_time)).size());
  }
  for (const auto& style : report["styles"]) {
    EXPECT_EQ(style["clips"], clips[style["style"]]) << style;
    EXPECT_EQ(style["cycles"], cycles[style["style"]]) << style;
  }
}

TEST(Corpus, a_seed_gives_the_same_walks_again_and_another_gives_others) {
  const TestFolder folder;
  for (const auto& [name, seed] :
       std::map<std::string, std::string>{{"a", "7"}, {"b", "7"}, {"c", "8"}})
    ASSERT_EQ(run_tool({"corpus", folder / name, "--seed", seed}).exit_code, 0);
  EXPECT_EQ(bytes_of(folder / "a/walk_drunk_1.bvh"), bytes_of(folder / "b/walk_drunk_1.bvh"));
  EXPECT_EQ(bytes_of(folder / "a/walk_drunk_1.txt"), bytes_of(folder / "b/walk_drunk_1.txt"));
  EXPECT_NE(bytes_of(folder / "a/walk_drunk_1.bvh"), bytes_of(folder / "c/walk_drunk_1.bvh"));
}

TEST(Label, table_report_and_file_tell_of_the_same_steps) {
  const TestFolder folder;
  write_walk(folder / "walk.bvh");
  const ToolRun table = run_tool({"label", folder / "walk.bvh"});
  const ToolRun json =
      run_tool({"label", folder / "walk.bvh", "--json", "-o", folder / "walk.txt", "--unit", "m"});
  const ToolRun htk = run_tool({"label", folder / "walk.bvh", "-o", folder / "walk.lab"});
  ASSERT_EQ(table.exit_code, 0) << table.err;
  ASSERT_EQ(json.exit_code, 0) << json.err;
  ASSERT_EQ(htk.exit_code, 0) << htk.err;

  const auto report = nlohmann::json::parse(json.out).at(0);
  const Clip clip = clip_from_bvh(read_bvh(folder / "walk.bvh"));
  const WalkTrack track = follow_walk(clip, find_roles(clip.skeleton));
  ASSERT_EQ(report["contacts"].size(), track.contacts.size());
  EXPECT_GE(track.contacts.size(), 8u) << "four cycles were asked for";
  for (std::size_t i = 0; i < track.contacts.size(); ++i) {
    EXPECT_EQ(report["contacts"][i]["frame"], track.contacts[i].frame);
    EXPECT_EQ(report["contacts"][i]["foot"], foot_name(track.contacts[i].foot));
  }
  // A line for the name, one for the clip, one for the columns, one for each contact.
  EXPECT_EQ(lines_of(table.out), 3 + static_cast<int>(track.contacts.size()));

  const LabelFile audacity = read_labels(folder / "walk.txt"),
                  lab = read_labels(folder / "walk.lab");
  EXPECT_EQ(audacity.form, LabelForm::audacity);
  EXPECT_EQ(lab.form, LabelForm::htk);
  EXPECT_EQ(contacts_from_labels(audacity.segments, clip.frame_rate), track.contacts);
  EXPECT_EQ(contacts_from_labels(lab.segments, clip.frame_rate), track.contacts);
}

TEST(Label, several_clips_go_into_a_folder) {
  const TestFolder folder;
  write_walk(folder / "a.bvh", "sad");
  write_walk(folder / "b.bvh", "proud");
  std::filesystem::create_directory(folder / "labels");
  const ToolRun run =
      run_tool({"label", folder / "a.bvh", folder / "b.bvh", "-o", folder / "labels"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_FALSE(read_labels(folder / "labels/a.txt").segments.empty());
  EXPECT_FALSE(read_labels(folder / "labels/b.txt").segments.empty());
}

TEST(Label, a_body_that_takes_no_step_ends_with_one_and_writes_nothing) {
  const TestFolder folder;
  write_file(folder / "pose.bvh", t_pose_z_up());
  const ToolRun run = run_tool({"label", folder / "pose.bvh", "-o", folder / "pose.txt"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("no steps"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find(folder / "pose.bvh"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "pose.txt"));
}

TEST(Label, what_has_no_legs_ends_with_one_and_names_the_file) {
  const TestFolder folder;
  write_file(folder / "crane.bvh", arm_of_a_crane(10));
  const ToolRun run = run_tool({"label", folder / "crane.bvh", "--unit", "cm", "--up", "y"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find(folder / "crane.bvh"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace gait::testing
