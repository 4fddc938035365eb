// gait train: which clips are learnt, what is known of them, and what is said.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "gait/corpus/corpus.h"
#include "gait/files/label_file.h"
#include "gait/model/model_file.h"
#include "sample_clips.h"
#include "walking_takes.h"

namespace gait::testing {
namespace {

using nlohmann::json;

// The report's entry of the clip whose path ends so.
json clip_of(const json& report, const std::string& ending) {
  for (const json& clip : report["clips"])
    if (clip["file"].get<std::string>().ends_with(ending)) return clip;
  ADD_FAILURE() << "no clip " << ending << " in " << report.dump(1);
  return {};
}

json train_and_report(const std::vector<std::string>& clips, const std::string& model,
                      std::vector<std::string> more = {}) {
  more.push_back("--json");
  const ToolRun run = train_quickly(clips, model, more);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return json::parse(run.out);
}

TEST(Train, a_folder_becomes_a_model_with_the_styles_its_names_say) {
  const TestFolder folder;
  write_takes(folder / "walks");
  const json report = train_and_report({folder / "walks"}, folder / "m.gait", {"--synthetic"});
  EXPECT_EQ(report["clips_used"], 6);
  EXPECT_EQ(report["styles"], json({"proud", "sad"}));
  EXPECT_EQ(clip_of(report, "walk_sad_2.bvh")["style"], "sad");
  EXPECT_GE(clip_of(report, "walk_sad_2.bvh")["steps"], 6);
  EXPECT_GT(report["validated"]["step_accuracy"], 0.8);
  EXPECT_EQ(report["states_per_label"], 3);

  const Model model = read_model(folder / "m.gait");
  EXPECT_EQ(model.name, "m");
  EXPECT_TRUE(model.training.synthetic);
  EXPECT_EQ(model.styles, (std::vector<std::string>{"proud", "sad"}));
  EXPECT_EQ(model.training.clips.size(), 6u);
  EXPECT_EQ(model.training.clips[0].find('/'), std::string::npos) << "a path of this machine";
  ASSERT_EQ(model.labels.size(), 2u);
  EXPECT_EQ(model.labels[0].successors, std::vector<int>{1});
  EXPECT_EQ(model.labels[1].successors, std::vector<int>{0});
}

TEST(Train, what_is_not_said_is_chosen_by_cross_validation_and_reported) {
  const TestFolder folder;
  write_takes(folder / "walks");
  const ToolRun run =
      run_tool({"train", folder / "walks", "-o", folder / "m.gait", "--states", "3", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json report = json::parse(run.out);
  EXPECT_EQ(report["regularisation_chosen_by"], "cross-validation");
  double least = 1e9, chosen = -1;
  for (const json& trial : report["trials"])
    if (trial["rounds"] == 0 && trial["error_deg"] < least)
      least = trial["error_deg"], chosen = trial["regularisation"];
  EXPECT_EQ(report["regularisation"], chosen) << report["trials"].dump(1);
}

TEST(Train, the_model_is_the_same_to_the_byte_for_any_number_of_threads) {
  const TestFolder folder;
  write_takes(folder / "walks");
  setenv("SOURCE_DATE_EPOCH", "1700000000", 1);
  for (const std::string threads : {"1", "2", "5"}) {
    std::filesystem::create_directory(folder / threads);
    ASSERT_EQ(run_tool({"train", folder / "walks", "-o", folder / (threads + "/m.gait"), "--states",
                        "3", "--threads", threads})
                  .exit_code,
              0);
  }
  unsetenv("SOURCE_DATE_EPOCH");
  EXPECT_EQ(bytes_of(folder / "1/m.gait"), bytes_of(folder / "2/m.gait"));
  EXPECT_EQ(bytes_of(folder / "1/m.gait"), bytes_of(folder / "5/m.gait"));
  EXPECT_EQ(read_model(folder / "1/m.gait").training.date, "2023-11-14T22:13:20Z");
}

TEST(Train, label_reads_style_subject_and_speed_from_names) {
  const TestFolder folder;
  write_take(folder / "anna-in_a_hurry-1.5_7.bvh", "in-a-hurry", 1);
  write_take(folder / "bob-sad-0.7_8.BVH", "sad", 1);
  write_take(folder / "other.bvh", "sad", 2);
  const json report = train_and_report({folder.path()}, folder / "m.gait",
                                       {"--label", "{subject}-{style}-{speed}_{take}.bvh"});
  const json anna = clip_of(report, "anna-in_a_hurry-1.5_7.bvh");
  EXPECT_EQ(anna["style"], "in_a_hurry");
  EXPECT_EQ(anna["subject"], "anna");
  EXPECT_EQ(anna["speed"], 1.5);
  EXPECT_EQ(clip_of(report, "bob-sad-0.7_8.BVH")["style"], "sad");
  const json other = clip_of(report, "other.bvh");
  EXPECT_EQ(other["style"], "");
  EXPECT_TRUE(other["used"]);
  EXPECT_NE(other["remark"].get<std::string>().find("does not fit --label"), std::string::npos);
  EXPECT_NE(report["notes"].dump().find(
                "one clip, whose recognition could not be validated: in_a_hurry, sad"),
            std::string::npos)
      << report["notes"];
}

TEST(Train, a_pattern_that_reads_nothing_or_is_misspelt_is_wrong_use) {
  const TestFolder folder;
  write_take(folder / "a.bvh", "sad", 1);
  for (const std::string pattern : {"walk.bvh", "{style", "{stile}", "{style}_{style}", "{take}"}) {
    const ToolRun run = train_quickly({folder / "a.bvh"}, folder / "m.gait", {"--label", pattern});
    EXPECT_EQ(run.exit_code, 2) << pattern;
    EXPECT_NE(run.err.find(pattern), std::string::npos) << run.err;
    EXPECT_EQ(lines_of(run.err), 1) << run.err;
  }
}

TEST(Train, a_manifest_says_which_clips_and_what_they_are) {
  const TestFolder folder;
  write_takes(folder / "takes", 1, 2);
  std::filesystem::rename(folder / "takes/walk_sad_2.bvh", folder / "takes/x, \"y\".bvh");
  write_file(folder / "walks.csv",
             "\xEF\xBB\xBFspeed,file,style\r\n"
             "1.25,takes/walk_proud_1.bvh,haughty\r\n"
             "\r\n"
             ",\"takes/x, \"\"y\"\".bvh\",\"low, slow\"\r\n"
             ",takes/walk_sad_1.bvh,");
  const json report = train_and_report({"--manifest", folder / "walks.csv"}, folder / "m.gait");
  EXPECT_EQ(report["clips"].size(), 3u) << "only what the manifest names";
  EXPECT_EQ(clip_of(report, "walk_proud_1.bvh")["style"], "haughty");
  EXPECT_EQ(clip_of(report, "walk_proud_1.bvh")["speed"], 1.25);
  EXPECT_EQ(clip_of(report, "\"y\".bvh")["style"], "low, slow");
  EXPECT_EQ(clip_of(report, "walk_sad_1.bvh")["style"], "sad") << "by its name";
}

TEST(Train, a_wrong_manifest_is_named_with_its_line) {
  const TestFolder folder;
  write_take(folder / "a.bvh", "sad", 1);
  const std::pair<std::string, std::string> faults[] = {
      {"", ":1: "},
      {"clip,style\na.bvh,sad\n", ":1: "},
      {"file,style\na.bvh,sad,3\n", ":2: expected 2 fields, found 3"},
      {"file,speed\n\na.bvh,fast\n", ":3: expected a speed in m/s, found 'fast'"},
      {"file,style\na.bvh,sad\nb.bvh,sad\n", ":3: there is no file"},
      {"file,style\na.bvh,\"sad\n", ":2: expected a closing double quote"},
      {"file,style\na.bvh,sad\n./a.bvh,proud\n", ":3: "},
      {"file,style\n,sad\n", ":2: expected the name of a file"}};
  for (const auto& [text, says] : faults) {
    write_file(folder / "walks.csv", text);
    const ToolRun run =
        train_quickly({folder / "a.bvh"}, folder / "m.gait", {"--manifest", folder / "walks.csv"});
    EXPECT_EQ(run.exit_code, 1) << text;
    EXPECT_NE(run.err.find(folder / "walks.csv" + says), std::string::npos) << run.err;
  }
}

TEST(Train, label_files_beside_clips_say_when_feet_touch_unless_told_not_to) {
  const TestFolder folder;
  WalkPlan plan;
  plan.style = corpus_style("proud");
  const CorpusWalk walk = make_walk(plan);
  write_take(folder / "walk_proud_1.bvh", "proud", 1, plan.cycles);
  write_take(folder / "walk_proud_2.bvh", "proud", 2);
  // Only the first six contacts: fewer steps than the walk has.
  const std::vector<Contact> some(walk.contacts.begin(), walk.contacts.begin() + 6);
  write_labels(labels_from_contacts(some, 30), LabelForm::htk, folder / "walk_proud_1.lab");
  const json with = train_and_report({folder.path()}, folder / "a.gait");
  const json first = clip_of(with, "walk_proud_1.bvh");
  EXPECT_EQ(first["steps"], 5);
  EXPECT_NE(first["remark"].get<std::string>().find("contacts from walk_proud_1.lab"),
            std::string::npos);
  const json without = train_and_report({folder.path()}, folder / "b.gait", {"--no-labels"});
  EXPECT_GT(clip_of(without, "walk_proud_1.bvh")["steps"], 5);

  write_file(folder / "walk_proud_1.lab", "not a label file\n");
  const ToolRun wrong = train_quickly({folder.path()}, folder / "c.gait");
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_NE(wrong.err.find("walk_proud_1.lab:1"), std::string::npos) << wrong.err;
  EXPECT_NE(wrong.err.find("--no-labels"), std::string::npos) << wrong.err;
  write_file(folder / "walk_proud_1.lab", "0 900000000 right\n900000000 910000000 left\n");
  const ToolRun late = train_quickly({folder.path()}, folder / "c.gait");
  EXPECT_EQ(late.exit_code, 1);
  EXPECT_NE(late.err.find("within the clip"), std::string::npos) << late.err;
}

TEST(Train, a_clip_with_too_few_steps_is_left_out_with_a_word_and_none_left_is_an_error) {
  const TestFolder folder;
  write_takes(folder / "walks", 1, 2);
  write_take(folder / "walks/walk_sad_9.bvh", "sad", 9, 1);
  const json report = train_and_report({folder / "walks"}, folder / "m.gait");
  const json left_out = clip_of(report, "walk_sad_9.bvh");
  EXPECT_FALSE(left_out["used"]);
  EXPECT_NE(left_out["why_not"].get<std::string>().find("4 steps"), std::string::npos) << left_out;
  EXPECT_EQ(report["clips_used"], 4);
  const ToolRun table = train_quickly({folder / "walks"}, folder / "m.gait");
  EXPECT_NE(table.out.find("NOT USED"), std::string::npos) << table.out;

  const ToolRun none = train_quickly({folder / "walks/walk_sad_9.bvh"}, folder / "none.gait");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("none of 1"), std::string::npos) << none.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "none.gait"));
}

TEST(Train, a_broken_file_among_many_ends_it_with_file_and_line) {
  const TestFolder folder;
  write_takes(folder / "walks", 1, 2);
  std::string text = bytes_of(folder / "walks/walk_sad_1.bvh");
  write_file(folder / "walks/walk_sad_3.bvh", text.replace(text.size() * 2 / 3, 1, "x"));
  const ToolRun run = train_quickly({folder / "walks"}, folder / "m.gait");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("walk_sad_3.bvh:"), std::string::npos) << run.err;
  EXPECT_EQ(lines_of(run.err), 1) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "m.gait"));
}

TEST(Train, bodies_that_differ_are_an_error_that_names_the_joints) {
  const TestFolder folder;
  write_takes(folder / "walks", 1, 2);
  std::string text = bytes_of(folder / "walks/walk_proud_2.bvh");
  for (std::size_t at = 0; (at = text.find("LeftForeArm", at)) != std::string::npos;)
    text.replace(at, 11, "LeftElbow");
  write_file(folder / "walks/walk_proud_2.bvh", text);
  const ToolRun run = train_quickly({folder / "walks"}, folder / "m.gait");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("walk_proud_2.bvh"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("LeftForeArm"), std::string::npos) << run.err;
}

TEST(Train, other_frame_rates_are_resampled_and_that_is_said) {
  const TestFolder folder;
  write_takes(folder / "walks", 1, 2);
  write_take(folder / "walks/walk_sad_3.bvh", "sad", 3, 4, 120);
  const json report = train_and_report({folder / "walks"}, folder / "m.gait");
  EXPECT_EQ(report["frame_rate"], 30.0);
  EXPECT_NE(clip_of(report, "walk_sad_3.bvh")["remark"].get<std::string>().find("from 120 to 30"),
            std::string::npos);
  EXPECT_EQ(clip_of(report, "walk_sad_2.bvh")["remark"], "");
}

TEST(Train, joints_states_rate_and_history_are_as_asked) {
  const TestFolder folder;
  write_takes(folder / "walks", 1, 2);
  ASSERT_EQ(train_quickly({folder / "walks"}, folder / "m.gait",
                          {"--output-joints", "LeftArm,LeftForeArm", "--input-joints",
                           "RightArm,RightForeArm,Spine", "--rate", "20", "--history", "200,50",
                           "--decoder", "forward", "--comment", "arms"})
                .exit_code,
            0);
  const Model model = read_model(folder / "m.gait");
  ASSERT_EQ(model.outputs.size(), 2u);
  EXPECT_EQ(model.outputs[0].name, "LeftArm");
  EXPECT_EQ(model.inputs.size(), 3u);
  EXPECT_EQ(model.frame_rate, 20);
  EXPECT_EQ(model.input.lags, (std::vector<int>{1, 4}));
  EXPECT_EQ(model.play.decoder, DecoderKind::forward);
  EXPECT_EQ(model.training.comment, "arms");

  const ToolRun unknown =
      train_quickly({folder / "walks"}, folder / "n.gait", {"--output-joints", "LeftWing"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.err.find("LeftWing"), std::string::npos) << unknown.err;
}

TEST(Train, interrupted_it_ends_with_one_and_leaves_no_model) {
  const TestFolder folder;
  // Enough to be at work for a while. In the foreground timeout signals once; a second would kill.
  ASSERT_EQ(run_tool({"corpus", folder / "walks"}).exit_code, 0);
  const std::string command = "timeout --foreground --preserve-status -s INT 1 '" +
                              std::string(GAIT_TOOL) + "' train '" + folder / "walks" +
                              "' --states 20 -o '" + folder / "m.gait" + "' 2> '" +
                              folder / "said" + "'";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_EQ(bytes_of(folder / "said"), "gait train: cancelled\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "m.gait"));
  EXPECT_FALSE(std::filesystem::exists(folder / "m.gait.part"));
}

TEST(Train, without_clips_or_with_absurd_figures_it_is_used_wrongly) {
  const TestFolder folder;
  EXPECT_EQ(run_tool({"train", "-o", folder / "m.gait"}).exit_code, 2);
  EXPECT_EQ(run_tool({"train", folder.path()}).exit_code, 2);
  for (const auto& [option, value] : {std::pair<std::string, std::string>{"--states", "0"},
                                      {"--rate", "0"},
                                      {"--threads", "-1"},
                                      {"--regularisation", "nan"},
                                      {"--history", "0"},
                                      {"--decoder", "guess"}}) {
    const ToolRun run = run_tool({"train", folder.path(), "-o", folder / "m.gait", option, value});
    EXPECT_EQ(run.exit_code, 2) << option;
    EXPECT_NE(run.err.find(option), std::string::npos) << run.err;
  }
  EXPECT_EQ(run_tool({"train", folder.path(), "-o", folder / "m.gait"}).exit_code, 1)
      << "an empty folder";
}

}  // namespace
}  // namespace gait::testing
