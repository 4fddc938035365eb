// Clips that are odd in what they say of themselves: units of children, rest poses first, wrong
// clocks, short takes, loops, cut rows, and motion that is no walk. Each through the real program.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "gait/corpus/corpus.h"
#include "gait/files/bvh.h"
#include "gait/motion/joint_roles.h"
#include "gait/motion/rotation.h"
#include "shared_data.h"
#include "tool_runner.h"

namespace gait::testing {
namespace {

using Json = nlohmann::json;

std::string kept(const std::string& name) { return GAIT_TEST_CASES "/" + name + ".bvh"; }

Clip walk(const std::string& style, int cycles, double frame_rate = 30, int take = 1) {
  WalkPlan plan;
  plan.style = corpus_style(style);
  plan.cycles = cycles;
  plan.take = take;
  return make_walk(plan, frame_rate).clip;
}

Clip frames_of(const Clip& clip, int begin, int end) {
  Clip part = clip;
  const std::ptrdiff_t joints = clip.skeleton.size();
  part.rotations.assign(clip.rotations.begin() + begin * joints,
                        clip.rotations.begin() + end * joints);
  part.translations.assign(clip.translations.begin() + begin * joints,
                           clip.translations.begin() + end * joints);
  return part;
}

Clip scaled(Clip clip, double factor) {
  for (Joint& joint : clip.skeleton.joints) {
    joint.offset *= factor;
    for (Eigen::Vector3d& tip : joint.tips) tip *= factor;
  }
  for (Eigen::Vector3d& translation : clip.translations) translation *= factor;
  return clip;
}

void write_clip(const Clip& clip, const std::string& path) { write_bvh(bvh_from_clip(clip), path); }

// What `gait label --json` says of one clip.
struct Labelled {
  Json clip;
  std::string warnings;
};
Labelled labelled(const std::string& path, std::vector<std::string> more = {}) {
  std::vector<std::string> words{"label", path, "--json"};
  words.insert(words.end(), more.begin(), more.end());
  const ToolRun run = run_tool(words);
  const Json report = Json::parse(run.out, nullptr, false);
  if (report.is_discarded() || report.empty()) {
    ADD_FAILURE() << path << ": " << run.err;
    return {};
  }
  return {report.front(), run.err};
}

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

TEST(OddClips, a_childs_leg_in_inches_is_not_a_giants_in_another_unit) {
  const Labelled child = labelled(kept("child-inches"));
  EXPECT_NEAR(child.clip["leg_length"].get<double>(), 0.515, 0.005);
  EXPECT_NEAR(child.clip["speed"].get<double>(), 0.98, 0.03);
  EXPECT_TRUE(says(child.warnings, "--unit in or --unit cmu")) << child.warnings;

  // By leg and unit. A child's steps are as quick as its legs are short: time runs faster.
  const TestFolder folder;
  struct Known {
    double leg, metres_per_unit;
    bool doubted;
  };
  for (const Known& known :
       {Known{0.55, 0.01, false}, Known{0.6, 0.0254, false}, Known{0.45, 1, false},
        Known{0.5, 0.001, false}, Known{0.3, 1, false}, Known{0.65, 0.01, false},
        Known{0.35, 0.001, false}, Known{0.45, 0.1, true}, Known{0.87, 0.0254, false},
        Known{0.83, 0.1, false}}) {
    Clip clip = scaled(walk("neutral", 4), known.leg / 0.83 / known.metres_per_unit);
    clip.frame_rate *= std::sqrt(0.83 / known.leg);
    write_clip(clip, folder / "walk.bvh");
    const Labelled found = labelled(folder / "walk.bvh");
    EXPECT_NEAR(found.clip["leg_length"].get<double>(), known.leg, 0.02 * known.leg)
        << known.metres_per_unit;
    EXPECT_EQ(says(found.warnings, "--unit"), known.doubted)
        << known.leg << " " << known.metres_per_unit << ": " << found.warnings;
  }
}

TEST(OddClips, a_rest_pose_in_the_first_row_is_no_contact) {
  const Json contacts = labelled(kept("t-pose-first")).clip["contacts"];
  EXPECT_EQ(contacts[0]["frame"], 11);
  EXPECT_EQ(contacts[0]["foot"], "right");
  EXPECT_EQ(contacts.size(), 5u);
}

TEST(OddClips, a_rest_pose_stays_in_the_file_when_legs_are_found_again) {
  const TestFolder folder;
  ASSERT_EQ(run_tool({"reconstruct", "gait-demo", kept("t-pose-first"), "-o", folder / "found.bvh",
                      "--csv", folder / "found.csv"})
                .exit_code,
            0);
  const BvhFile before = read_bvh(kept("t-pose-first")), after = read_bvh(folder / "found.bvh");
  ASSERT_EQ(after.values.rows(), before.values.rows());
  EXPECT_EQ(after.values.row(0), before.values.row(0));
  EXPECT_NE(after.values.row(1), before.values.row(1));
  const Clip found = clip_from_bvh(after);
  // No jump of the root between the second row and the third, and the walk travels.
  EXPECT_LT((found.translation(2)[0] - found.translation(1)[0]).norm(), 0.1);
  EXPECT_GT((found.translation(75)[0] - found.translation(1)[0]).norm(), 3);
  EXPECT_TRUE(says(bytes_of(folder / "found.csv"), "\n0.033333,"));
}

TEST(OddClips, a_clock_that_nobody_walks_by_is_doubted_with_the_rate_that_is_meant) {
  const Labelled slow = labelled(kept("slow-clock"));
  EXPECT_TRUE(says(slow.warnings, "--fps 30")) << slow.warnings;
  const Labelled put_right = labelled(kept("slow-clock"), {"--fps", "30"});
  EXPECT_FALSE(says(put_right.warnings, "--fps")) << put_right.warnings;
  EXPECT_NEAR(put_right.clip["speed"].get<double>(), 1.6, 0.05);

  const TestFolder folder;
  for (const auto& [meant, written] : {std::pair{30.0, 100.0}, {60.0, 15.0}, {120.0, 30.0}}) {
    Clip clip = walk("neutral", 4, meant);
    clip.frame_rate = written;
    write_clip(clip, folder / "walk.bvh");
    const Labelled found = labelled(folder / "walk.bvh");
    EXPECT_TRUE(says(found.warnings, "frames per second")) << written << ": " << found.warnings;
    const std::size_t at = found.warnings.find("--fps ");
    ASSERT_NE(at, std::string::npos);
    EXPECT_NEAR(std::stod(found.warnings.substr(at + 6)) / meant, 1, 0.25) << found.warnings;
  }
}

TEST(OddClips, every_command_that_reads_clips_takes_the_rate) {
  const TestFolder folder;
  const std::string slow = kept("slow-clock"), model = folder / "m.gait";
  const auto well = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--fps", "30"});
    const ToolRun run = run_tool(words);
    EXPECT_EQ(run.exit_code, 0) << words[0] << ": " << run.err;
    EXPECT_FALSE(says(run.err, "slower than people walk")) << words[0] << ": " << run.err;
  };
  well({"train", slow, "-o", model});
  well({"evaluate", model, slow});
  well({"reconstruct", model, slow, "-o", folder / "found.bvh"});
  EXPECT_NEAR(read_bvh(folder / "found.bvh").frame_time, 1.0 / 30, 1e-9);
  well({"render", slow, "-o", folder / "walk.svg"});
  EXPECT_EQ(run_tool({"label", slow, "--fps", "0"}).exit_code, 2);
}

TEST(OddClips, short_takes_are_learnt_from_together) {
  const TestFolder folder;
  const ToolRun kept_takes = run_tool({"train", kept("short-take-1"), kept("short-take-2"),
                                       kept("short-take-3"), "-o", folder / "m.gait", "--json"});
  ASSERT_EQ(kept_takes.exit_code, 0) << kept_takes.err;
  EXPECT_EQ(Json::parse(kept_takes.out)["clips_used"], 3);

  // Two styles in takes of one and two steps; one style has too few.
  for (const std::string style : {"proud", "sad"}) {
    const Clip whole = walk(style, 6);
    const auto contacts = make_walk({.style = corpus_style(style), .cycles = 6}).contacts;
    for (std::size_t take = 0; take + 3 < contacts.size(); ++take)
      write_clip(frames_of(whole, std::max(0, contacts[take].frame - 12),
                           contacts[take + 1 + take % 2].frame + 3),
                 folder / ("walk_" + style + "_" + std::to_string(take) + ".bvh"));
  }
  write_clip(frames_of(walk("drunk", 6), 0, 40), folder / "walk_drunk_1.bvh");
  const ToolRun run = run_tool({"train", folder.path(), "-o", folder / "s.gait", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json report = Json::parse(run.out);
  EXPECT_EQ(report["styles"], Json({"proud", "sad"}));
  EXPECT_GE(report["clips_used"].get<int>(), 16);
  for (const Json& clip : report["clips"])
    if (clip["style"] == "drunk") {
      EXPECT_FALSE(clip["used"].get<bool>());
      EXPECT_TRUE(says(clip["why_not"], "4 steps")) << clip["why_not"];
    }
  const ToolRun walked = run_tool({"synth", folder / "s.gait", "--style", "proud", "--seconds", "4",
                                   "-o", folder / "proud.bvh"});
  EXPECT_EQ(walked.exit_code, 0) << walked.err;
  // One alone still says how much it takes.
  const ToolRun alone = run_tool({"train", kept("short-take-1"), "-o", folder / "a.gait"});
  EXPECT_EQ(alone.exit_code, 1);
  EXPECT_TRUE(says(alone.err, "4 steps together")) << alone.err;
}

// A cycle from a walk whose last pose is its first, at whatever moment it begins.
TEST(OddClips, loops_are_cycles) {
  const TestFolder folder;
  int n = 0;
  for (const bool in_place : {false, true})
    for (const int begin : {0, 7, 15}) {
      const auto source = make_walk({.style = corpus_style("neutral"), .cycles = 3});
      const int first = source.contacts[2].frame + begin,
                period = source.contacts[4].frame - source.contacts[2].frame;
      Clip loop = frames_of(source.clip, first, first + period + 1);
      // What the body does not repeat by itself is shared out over the cycle.
      for (int frame = 0; frame <= period; ++frame)
        for (int joint = 0; joint < loop.skeleton.size(); ++joint) {
          const Eigen::Quaterniond gap =
              source.clip.pose(first)[joint] * source.clip.pose(first + period)[joint].conjugate();
          loop.pose(frame)[joint] =
              Eigen::Quaterniond::Identity().slerp(1.0 * frame / period, gap) *
              loop.pose(frame)[joint];
        }
      const Eigen::Vector3d travel = loop.translation(period)[0] - loop.translation(0)[0];
      for (int frame = 0; frame <= period; ++frame) {
        const double share = 1.0 * frame / period;
        loop.translation(frame)[0].y() -= share * travel.y();
        if (in_place)
          loop.translation(frame)[0] -= share * Eigen::Vector3d(travel.x(), 0, travel.z());
      }
      write_clip(loop, folder / ("walk_neutral_" + std::to_string(++n) + ".bvh"));
      const Json found = labelled(folder / ("walk_neutral_" + std::to_string(n) + ".bvh")).clip;
      EXPECT_TRUE(found["loop"].get<bool>()) << n;
      EXPECT_EQ(found["contacts"].size(), 2u) << n;
      EXPECT_NEAR(found["cycle_seconds"].get<double>(), period / 30.0, 0.04);
      EXPECT_NEAR(found["speed"].get<double>(), travel.norm() * 30 / period, 0.06 * travel.norm());
    }
  const ToolRun run = run_tool({"train", folder / "walk_neutral_1.bvh", "-o", folder / "m.gait"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(says(run.out, "a loop, gone round")) << run.out;
}

TEST(OddClips, a_last_row_that_broke_off_is_left_out_with_a_warning) {
  const Labelled cut = labelled(kept("cut-short"));
  EXPECT_EQ(cut.clip["frames"], 59);
  EXPECT_TRUE(says(cut.warnings, "found 59 whole ones")) << cut.warnings;
  const TestFolder folder;
  const std::string whole = bytes_of(kept("short-take-1"));
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (const std::string& text : {whole.substr(0, last), whole.substr(0, last) + "0.1 -"}) {
    write_file(folder / "walk.bvh", text);
    const Labelled found = labelled(folder / "walk.bvh");
    EXPECT_EQ(found.clip["frames"], 59);
    EXPECT_TRUE(says(found.warnings, "found 59")) << found.warnings;
  }
}

// Motion by roles: `turn` gives each frame's rotations, in radians about X (forward) and Z (out).
template <typename Move>
Clip moved(Move move, int frames = 150) {
  Clip clip = walk("neutral", 2);
  const Eigen::Vector3d place = clip.translation(0)[0];
  const JointRoles roles = find_roles(clip.skeleton);
  clip.resize(frames);
  for (int frame = 0; frame < frames; ++frame) {
    clip.translation(frame)[0] = {0, place.y(), 0};
    const auto turn = [&](Role role, double forward, double out) {
      clip.pose(frame)[roles.joint(role)] = exponential_map<double>({-forward, 0, out});
    };
    move(frame / 30.0, turn, clip.translation(frame)[0]);
  }
  return clip;
}

TEST(OddClips, what_is_no_walk_says_what_does_not_look_like_walking) {
  const double turn = 2 * 3.14159265358979;
  const TestFolder folder;
  write_clip(moved([&](double t, auto set, Eigen::Vector3d& place) {  // jumping jacks
               const double open = 0.5 - 0.5 * std::cos(turn * t);
               set(Role::left_thigh, 0, 0.5 * open);
               set(Role::right_thigh, 0, -0.5 * open);
               set(Role::left_arm, 0, 1.2 * open);
               set(Role::right_arm, 0, -1.2 * open);
               place.y() += 0.25 * std::abs(std::sin(turn * t));
             }),
             folder / "jacks.bvh");
  write_clip(moved([&](double t, auto set, Eigen::Vector3d& place) {  // sits, and swings its feet
               for (const Role thigh : {Role::left_thigh, Role::right_thigh}) set(thigh, 1.5, 0);
               set(Role::left_shank, -1.4 + 0.4 * std::sin(turn * t), 0);
               set(Role::right_shank, -1.4 - 0.4 * std::sin(turn * t), 0);
               place.y() = 0.5;
             }),
             folder / "sits.bvh");
  write_clip(moved([&](double t, auto set, Eigen::Vector3d& place) {  // dances on the spot
               const double beat = std::sin(turn * t), off = std::sin(turn * t / 2.3);
               set(Role::left_thigh, 0.5 * beat, 0.2 * off);
               set(Role::right_thigh, 0.35 * std::sin(turn * t * 1.37), -0.25 * off);
               set(Role::left_shank, -0.3 - 0.3 * off, 0);
               place += Eigen::Vector3d(0.1 * off, 0.03 * beat, 0.1 * std::cos(turn * t));
             }),
             folder / "dances.bvh");
  Clip dog = walk("neutral", 4);
  for (int frame = 0; frame < dog.frames(); ++frame) {
    const JointRoles roles = find_roles(dog.skeleton);
    dog.pose(frame)[roles.joint(Role::spine)] = exponential_map<double>({1.5, 0, 0});
  }
  write_clip(dog, folder / "dog.bvh");
  for (const auto& [name, why] : std::map<std::string, std::string>{
           {"jacks", "sideways"}, {"sits", "sits or crouches"}, {"dances", ""}, {"dog", "leans"}}) {
    const ToolRun run = run_tool({"label", folder / (name + ".bvh")});
    EXPECT_TRUE(says(run.err, "does not look like walking")) << name << ": " << run.err << run.out;
    EXPECT_TRUE(says(run.err, why)) << name << ": " << run.err;
    EXPECT_FALSE(says(run.out, "m/s")) << name << ": " << run.out;
  }
}

TEST(OddClips, no_built_in_walk_is_doubted) {
  const TestFolder folder;
  ASSERT_EQ(run_tool({"corpus", folder / "walks", "--speeds"}).exit_code, 0);
  const ToolRun run = run_tool({"label", folder / "walks"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_TRUE(says(run.out, "none in doubt")) << run.out.substr(run.out.rfind("\n\n"));
}

TEST(OddClips, no_captured_walk_is_doubted) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  const std::string data = shared_data().string();
  const ToolRun run =
      run_tool({"label", data + "/cmu-walks", data + "/bandai-namco-1", data + "/bandai-namco-2"});
  const std::string summary = run.out.substr(run.out.rfind("\n\n"));
  EXPECT_TRUE(says(summary, "none in doubt")) << summary;
}

TEST(OddClips, a_folder_ends_with_one_summary_the_worst_first) {
  const TestFolder folder;
  for (const char* name : {"slow-clock", "t-pose-first", "child-inches", "cut-short"})
    std::filesystem::copy_file(kept(name), folder / (std::string(name) + ".bvh"));
  write_file(folder / "broken.bvh", "HIERARCHY\nnothing\n");
  const ToolRun run = run_tool({"label", folder.path()});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(says(run.err, "1 of 5 clips were refused")) << run.err;
  const std::string summary = run.out.substr(run.out.rfind("\n\n"));
  std::size_t before = 0;
  for (const char* part : {"5 clips, in doubt, worst first", "refused (1)", "broken.bvh:2",
                           "frame rate (1)", "slow-clock", "unit or axes (1)", "child-inches",
                           "rest pose (1)", "t-pose-first", "file (1)", "cut-short"}) {
    const std::size_t at = summary.find(part, before);
    ASSERT_NE(at, std::string::npos) << part << " in " << summary;
    before = at;
  }
  std::filesystem::create_directory(folder / "a");
  std::filesystem::copy_file(kept("cut-short"), folder / "a/cut-short.bvh");
  EXPECT_EQ(run_tool({"label", folder.path(), "-o", folder.path()}).exit_code, 2);
}

}  // namespace
}  // namespace gait::testing
