// The whole chain in Pd, recognised, mapped, synthesised and put on stage: the numbers are those
// that `gait reconstruct` writes, wherever its cords run, and nothing jumps when the stream is cut.
#include <gtest/gtest.h>

#include <fstream>

#include "gait/motion/rotation.h"
#include "gait/offline/reconstructed_clip.h"
#include "patches/viterbi_patch.h"

namespace gait::testing {
namespace {

using Row = std::vector<double>;

struct WholeChain : ChainPatch {
  int synth, skeleton;
  WholeChain() {
    synth = object("gait.synth gait-demo");
    skeleton = object("gait.skeleton gait-demo");
    connect(map, 0, synth);
    connect(synth, 0, skeleton);
    record(synth, 0, "synth");
    record(skeleton, 1, "body");
    record(skeleton, 2, "stage");
  }
  void play(const std::vector<std::pair<double, std::string>>& messages) {
    ChainPatch::play(messages);
    // The measured joints come to the stage first: the [receive] made last is served first.
    connect(object("r frames"), 0, skeleton, 1);
  }
};

BodyPoses poses_of(const CorpusWalk& walk) {
  const Body& body = *demo()->body;
  return body_poses(walk.clip, body, match_joints(body, walk.clip.skeleton, walk.clip.name),
                    body.heading_window);
}

ReconstructedClip reconstructed(const CorpusWalk& walk) {
  return reconstruct_clip(demo(), poses_of(walk), demo()->frame_rate, "walk", {});
}

// Rotations of a `pose` message.
std::vector<Eigen::Quaterniond> rotations(const Row& pose) {
  std::vector<Eigen::Quaterniond> result;
  for (std::size_t joint = 0; 3 * joint < pose.size(); ++joint)
    result.push_back(demo()->body->references[joint] *
                     exponential_map<double>(Eigen::Vector3d(pose[3 * joint], pose[3 * joint + 1],
                                                             pose[3 * joint + 2])));
  return result;
}

std::vector<std::pair<double, std::string>> timed(const Eigen::MatrixXf& inputs, int begin, int end,
                                                  double pause) {
  std::vector<std::pair<double, std::string>> messages;
  for (int frame = begin; frame < end; ++frame)
    messages.push_back({frame == begin ? pause : 1 / 30.0, message_of("in", inputs.col(frame))});
  return messages;
}

TEST(Chain, sends_what_reconstruct_writes) {
  GAIT_NEEDS_PD();
  for (const char* style : {"drunk", "in-a-hurry"}) {
    const CorpusWalk walk = unseen_walk(style);
    const Eigen::MatrixXf inputs = inputs_of(walk);
    WholeChain patch;
    auto messages = timed(inputs, 0, static_cast<int>(inputs.cols()), 0.1);
    messages.insert(messages.begin(), {0, "rate 30"});
    patch.play(messages);
    patch.quit_after(100 + 1000 * static_cast<double>(inputs.cols()) / 30);
    const PdRun run = run_pd(patch);
    ASSERT_EQ(run.exit_code, 0) << run.log;
    const ReconstructedClip expected = reconstructed(walk);
    const auto poses = run.numbers("body", "pose"), roots = run.numbers("body", "root");
    ASSERT_GE(poses.size(), static_cast<std::size_t>(inputs.cols()));
    const JointRoles roles = body_roles(*demo()->body);
    double worst = 0, worst_place = 0;
    for (int frame = 0; frame < inputs.cols(); ++frame) {
      const auto pose = rotations(poses[static_cast<std::size_t>(frame)]);
      for (std::size_t joint = 0; joint < pose.size(); ++joint)
        worst = std::max(worst, angle_between(pose[joint], expected.clip.pose(frame)[joint]));
      const Eigen::Vector3d hips = expected.clip.translation(frame)[roles.hips];
      for (int axis = 0; axis < 3; ++axis)
        worst_place = std::max(
            worst_place,
            std::abs(hips[axis] -
                     roots[static_cast<std::size_t>(frame)][static_cast<std::size_t>(axis)]));
    }
    std::printf("%s: %d frames, worst angle %.1e rad, worst place %.1e m\n", style,
                static_cast<int>(inputs.cols()), worst, worst_place);
    EXPECT_LT(worst, 2e-5);
    EXPECT_LT(worst_place, 2e-4);
  }
}

// What the core gives of these inputs, one output frame each.
std::vector<std::vector<float>> outputs_of(const Eigen::MatrixXf& inputs) {
  std::vector<std::vector<float>> outputs;
  StreamReconstructor reconstructor(demo());
  for (int frame = 0; frame < inputs.cols(); ++frame) {
    if (reconstructor.advance({inputs.col(frame).data(), static_cast<std::size_t>(inputs.rows())}))
      outputs.emplace_back(reconstructor.frame().outputs.begin(),
                           reconstructor.frame().outputs.end());
  }
  return outputs;
}

void expect_outputs(const std::vector<Row>& sent, const std::vector<std::vector<float>>& expected) {
  ASSERT_EQ(sent.size(), expected.size());
  for (std::size_t frame = 0; frame < sent.size(); ++frame) {
    ASSERT_EQ(sent[frame].size(), expected[frame].size());
    for (std::size_t i = 0; i < sent[frame].size(); ++i)
      ASSERT_NEAR(sent[frame][i], expected[frame][i], 2e-5) << "frame " << frame;
  }
}

TEST(Chain, works_the_same_inside_clone) {
  GAIT_NEEDS_PD();
  const std::string folder = ::testing::TempDir() + "gait_voices";
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/gait_voice.pd")
      << "#N canvas 0 0 400 400 12;\n#X obj 10 10 inlet;\n#X obj 10 40 gait.viterbi~;\n"
         "#X obj 10 70 gait.map;\n#X obj 10 100 gait.synth;\n#X obj 10 130 outlet;\n"
         "#X connect 0 0 1 0;\n#X connect 1 4 2 0;\n#X connect 2 0 3 0;\n#X connect 3 0 4 0;\n";
  const Eigen::MatrixXf sad = inputs_of(unseen_walk("sad")),
                        proud = inputs_of(unseen_walk("proud"));
  Patch patch;
  patch.declare("-path " + folder);
  patch.object("gait.model gait-demo -blocking");
  const int clone = patch.object("clone gait_voice 2");
  patch.record(clone, 0, "voices");
  std::vector<std::string> messages{"0 rate 30", "1 rate 30"};
  for (int frame = 0; frame < 60; ++frame) {
    messages.push_back(message_of("0 in", sad.col(frame)));
    messages.push_back(message_of("1 in", proud.col(frame)));
  }
  patch.at_start(messages, clone);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  std::vector<Row> voices[2];
  for (const std::string& line : run.recorded("voices"))
    for (const std::string voice : {"0", "1"}) {
      const std::string begin = "list " + voice + " out";
      if (!line.starts_with(begin)) continue;
      std::istringstream numbers(line.substr(begin.size()));
      Row row;
      for (double number; numbers >> number;) row.push_back(number);
      voices[voice == "1"].push_back(row);
    }
  expect_outputs(voices[0], outputs_of(sad.leftCols(60)));
  expect_outputs(voices[1], outputs_of(proud.leftCols(60)));
}

// Largest angle that any joint turns between frames, radians.
double largest_turn(const std::vector<Row>& poses, std::size_t begin, std::size_t end) {
  double largest = 0;
  for (std::size_t frame = begin + 1; frame < end; ++frame) {
    const auto a = rotations(poses[frame - 1]), b = rotations(poses[frame]);
    for (std::size_t joint = 0; joint < a.size(); ++joint)
      largest = std::max(largest, angle_between(a[joint], b[joint]));
  }
  return largest;
}

// What training shows: the walk's own largest turn.
double largest_turn(const CorpusWalk& walk) {
  const BodyPoses poses = poses_of(walk);
  double largest = 0;
  for (int frame = 1; frame < poses.frames(); ++frame)
    for (int joint = 0; joint < poses.joints; ++joint)
      largest =
          std::max(largest, angle_between(poses.pose(frame - 1)[joint], poses.pose(frame)[joint]));
  return largest;
}

TEST(Chain, goes_on_alone_when_the_stream_stops_and_takes_it_up_again_without_a_jump) {
  GAIT_NEEDS_PD();
  for (const char* style : {"proud", "sad", "drunk"}) {
    const CorpusWalk walk = unseen_walk(style, 8);
    const Eigen::MatrixXf inputs = inputs_of(walk);
    const int length = static_cast<int>(inputs.cols());
    ASSERT_GT(length, 170);
    WholeChain patch;
    auto messages = timed(inputs, 0, 70, 0.1);
    const auto rest = timed(inputs, 70, length, 1.5);
    messages.insert(messages.end(), rest.begin(), rest.end());
    messages.insert(messages.begin(), {0, "rate 30"});
    patch.play(messages);
    // Quits before the end is taken for another loss.
    patch.quit_after(1000 * (0.1 + 1.5 + (length - 1) / 30.0) + 50);
    const PdRun run = run_pd(patch);
    ASSERT_EQ(run.exit_code, 0) << run.log;
    const auto poses = run.numbers("body", "pose");
    // A quarter second until it is noticed, the rest of the pause walked, at 30 frames a second.
    EXPECT_NEAR(static_cast<double>(poses.size()), length + 1.25 * 30, 3);
    // From before the loss until it has been fed again for at least half a second; a mapped walk
    // alone may turn faster at other times.
    const double taught = largest_turn(walk), shown = largest_turn(poses, 66, 190);
    std::printf("%s: a joint turns by %.3f rad in a frame at most, in the capture by %.3f\n", style,
                shown, taught);
    EXPECT_LE(shown, 1.1 * taught) << style;
    // In the end it is fed again.
    const auto outputs = run.numbers("synth", "out");
    EXPECT_GT(outputs.size(), 100u);
    EXPECT_TRUE(run.recorded("synth").back().starts_with("out "));
    const auto expected = outputs_of(inputs.rightCols(length - 70));
    for (std::size_t i = 0; i < outputs.back().size(); ++i)
      EXPECT_NEAR(outputs.back()[i], expected.back()[i], 1e-3);
  }
}

TEST(Chain, goes_on_where_the_walk_is_when_a_cord_was_shut_for_a_while) {
  GAIT_NEEDS_PD();
  const CorpusWalk walk = unseen_walk("proud", 6);
  const Eigen::MatrixXf inputs = inputs_of(walk);
  const int length = static_cast<int>(inputs.cols());
  ChainPatch patch;
  const int gate = patch.object("spigot 1"), synth = patch.object("gait.synth gait-demo"),
            skeleton = patch.object("gait.skeleton gait-demo"), begin = patch.object("loadbang");
  patch.connect(patch.map, 0, gate);
  patch.connect(gate, 0, synth);
  patch.connect(synth, 0, skeleton);
  patch.record(skeleton, 1, "body");
  for (const auto& [time, what] : {std::pair(2000, "0"), {3100, "1"}}) {
    const int delay = patch.object("delay " + std::to_string(time)), box = patch.message(what);
    patch.connect(begin, 0, delay);
    patch.connect(delay, 0, box);
    patch.connect(box, 0, gate, 1);
  }
  auto messages = timed(inputs, 0, length, 0.1);
  messages.insert(messages.begin(), {0, "rate 30"});
  patch.play(messages);
  patch.quit_after(100 + 1000.0 * length / 30);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  const auto poses = run.numbers("body", "pose");
  EXPECT_NEAR(static_cast<double>(poses.size()), length - 33, 2);
  EXPECT_LE(largest_turn(poses, 3, poses.size()), 1.1 * largest_turn(walk));
}

}  // namespace
}  // namespace gait::testing
