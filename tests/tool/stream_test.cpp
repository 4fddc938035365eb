// gait stream and gait listen: a walk goes over a real socket and is the same walk at the other
// end.
#include <gtest/gtest.h>

#ifdef GAIT_TESTS_OSC

#include <csignal>
#include <cstdlib>
#include <numbers>
#include <thread>

#include "gait/corpus/corpus.h"
#include "gait/files/bvh.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"
#include "gait/osc/destination.h"
#include "gait/osc/forms.h"
#include "gait/osc/packet_template.h"
#include "gait/osc/receiver.h"
#include "osc/six_poses.h"
#include "tool_runner.h"

namespace gait::testing {
namespace {

constexpr double degree = std::numbers::pi / 180;

// A port that nobody has just now.
std::string free_port() { return std::to_string(osc::Receiver({.port = 0}).port()); }

std::string written_walk(const TestFolder& folder) {
  CorpusWalk walk = make_walk({.style = corpus_style("drunk"), .cycles = 1});
  write_bvh(bvh_from_clip(walk.clip), folder / "walk.bvh");
  return folder / "walk.bvh";
}

Clip read(const std::string& path) { return clip_from_bvh(read_bvh(path)); }

// Writes what is heard while `form` is streamed.
void hear(const std::string& walk, const std::string& form, const std::string& to) {
  const std::string port = free_port();
  int listened = -1;
  std::thread listener([&] {
    listened = std::system(
        ("'" GAIT_TOOL "' listen " + port + " -o '" + to + "' --seconds 4.5 >/dev/null 2>&1")
            .c_str());
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));  // until it listens
  const ToolRun streamed = run_tool({"stream", walk, "--to", "localhost:" + port, "--form", form});
  EXPECT_EQ(streamed.exit_code, 0) << streamed.err;
  listener.join();
  EXPECT_EQ(listened, 0);
}

TEST(StreamAndListen, the_rig_itself_comes_out_as_it_went_in) {
  const TestFolder folder;
  const std::string walk = written_walk(folder);
  hear(walk, "gait", folder / "out.bvh");
  const Clip sent = read(walk), got = read(folder / "out.bvh");
  ASSERT_EQ(got.frames(), sent.frames());
  EXPECT_NEAR(got.frame_rate, sent.frame_rate, 1);
  ASSERT_EQ(got.skeleton.size(), sent.skeleton.size());
  for (int joint = 0; joint < sent.skeleton.size(); ++joint) {
    const int at = got.skeleton.find(sent.skeleton.joints[joint].name);
    ASSERT_GE(at, 0);
    for (int frame = 0; frame < sent.frames(); ++frame) {
      EXPECT_LT(angle_between(got.pose(frame)[at], sent.pose(frame)[joint]), 0.1 * degree);
      EXPECT_LT((got.translation(frame)[at] - sent.translation(frame)[joint]).norm(), 1e-3);
    }
  }
}

// In VMC the rig rests in the T-pose: what stays the same is where every joint is.
TEST(StreamAndListen, in_vmc_every_bone_points_where_it_did) {
  const TestFolder folder;
  const std::string walk = written_walk(folder);
  hear(walk, "vmc", folder / "out.bvh");
  const Clip sent = read(walk), got = read(folder / "out.bvh");
  ASSERT_EQ(got.frames(), sent.frames());
  const WorldPoses before = world_poses(sent), after = world_poses(got);
  const auto place = [](const Clip& clip, const WorldPoses& world, int frame,
                        const std::string& name) {
    const int joint = clip.skeleton.find(name);
    EXPECT_GE(joint, 0) << name;
    return world.positions[static_cast<std::size_t>(frame * clip.skeleton.size() + joint)];
  };
  const std::vector<std::array<std::string, 4>> bones{
      {"Hips", "Head", "Hips", "Head"},
      {"LeftArm", "LeftForeArm", "LeftUpperArm", "LeftLowerArm"},
      {"RightForeArm", "RightHand", "RightLowerArm", "RightHand"},
      {"LeftUpLeg", "LeftLeg", "LeftUpperLeg", "LeftLowerLeg"},
      {"RightLeg", "RightFoot", "RightLowerLeg", "RightFoot"}};
  for (int frame = 0; frame < sent.frames(); ++frame)
    for (const auto& [from, to, bone, end] : bones) {
      if (sent.skeleton.find(from) < 0 || sent.skeleton.find(to) < 0) continue;
      const Eigen::Vector3d was = place(sent, before, frame, to) - place(sent, before, frame, from);
      const Eigen::Vector3d is = place(got, after, frame, end) - place(got, after, frame, bone);
      EXPECT_LT(std::acos(std::min(1.0, was.normalized().dot(is.normalized()))), 0.1 * degree)
          << bone << " in frame " << frame;
      EXPECT_NEAR(was.norm(), is.norm(), 1e-3);
    }
}

TEST(StreamAndListen, say_what_is_wrong_in_one_line) {
  const TestFolder folder;
  const std::string walk = written_walk(folder);
  const auto refused = [&](const std::vector<std::string>& arguments, int code,
                           const std::string& words) {
    const ToolRun run = run_tool(arguments);
    EXPECT_EQ(run.exit_code, code) << run.err;
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
  };
  refused({"stream", walk, "--to", "localhost"}, 2, "expected HOST:PORT");
  refused({"stream", walk, "--to", "localhost:0"}, 2, "expected HOST:PORT");
  refused({"stream", walk, "--to", "localhost:39539", "--form", "fax"}, 2, "--form");
  refused({"stream", walk, "--to", "no.such.host.invalid:39539"}, 1, "no host of that name");
  refused({"stream", folder / "none.bvh", "--to", "localhost:39539"}, 1, "none.bvh");
  const osc::Receiver taken({.port = 0});
  refused({"listen", std::to_string(taken.port()), "-o", folder / "a.bvh"}, 1,
          "is taken by another program");
  refused({"listen", free_port(), "-o", folder / "a.bvh", "--seconds", "0.2"}, 1, "no frame");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.bvh"));
}

// Six poses through `gait stream` and `gait listen` in each form, over real sockets.
TEST(StreamAndListen, six_poses_arrive_in_every_form_to_a_tenth_of_a_degree) {
  const TestFolder folder;
  const std::vector<HumanoidPose> poses = six_poses();
  // A rig of Unity's bones, each pose a quarter of a second.
  Clip clip;
  clip.frame_rate = 60;
  for (int bone = 0; bone < main_bones; ++bone)
    clip.skeleton.joints.push_back({std::string(bone_name(bone)),
                                    bone_parent(bone),
                                    bone == 0 ? Eigen::Vector3d(0, 0, 0) : usual_offset(bone),
                                    {}});
  clip.resize(15 * static_cast<int>(poses.size() + 1));
  for (int frame = 0; frame < clip.frames(); ++frame) {
    // First the head the other way: what a rig's straight head is, is judged from the mean.
    const int which = frame / 15 - 1;
    const HumanoidPose pose =
        which < 0 ? posed({{Bone::head, poses[3].turns[index_of(Bone::head)].conjugate()}})
                  : poses[static_cast<std::size_t>(which)];
    for (int bone = 0; bone < main_bones; ++bone) clip.pose(frame)[bone] = pose.local_turn(bone);
    clip.translation(frame)[0] = pose.places[0];
  }
  write_bvh(bvh_from_clip(clip), folder / "six.bvh");
  for (const std::string& form : osc::form_names(true)) {
    if (form == "gait") continue;
    const std::string port = free_port(), out = folder / (form + ".bvh");
    int listened = -1;
    std::thread listener([&] {
      listened = std::system(
          ("'" GAIT_TOOL "' listen " + port + " -o '" + out + "' --seconds 4 >/dev/null 2>&1")
              .c_str());
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    const ToolRun streamed =
        run_tool({"stream", folder / "six.bvh", "--to", "localhost:" + port, "--form", form});
    EXPECT_EQ(streamed.exit_code, 0) << streamed.err;
    listener.join();
    ASSERT_EQ(listened, 0) << form;
    const Clip got = read(out);
    ASSERT_NEAR(got.frames(), clip.frames(), 2) << form;
    const WorldPoses world = world_poses(got);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      // In the midst of the pose, counted from the end.
      const int frame = got.frames() - 15 * static_cast<int>(poses.size() - i) + 7;
      HumanoidPose pose;
      for (int bone = 0; bone < humanoid_bones; ++bone) {
        const int joint = got.skeleton.find(std::string(bone_name(bone)));
        if (joint < 0) continue;
        const auto at = static_cast<std::size_t>(frame * got.skeleton.size() + joint);
        pose.turned.set(static_cast<std::size_t>(bone));
        pose.turns[static_cast<std::size_t>(bone)] = world.rotations[at];
        pose.placed.set(static_cast<std::size_t>(bone));
        pose.places[static_cast<std::size_t>(bone)] = world.positions[at];
      }
      expect_same_body(poses[i], pose, *osc::form_named(form),
                       form + ", pose " + std::to_string(i));
    }
  }
}

// A program that tracks arms and a face, as ../shared/cases/vmc-no-hips.py is one.
class NoHips {
 public:
  explicit NoHips(const std::string& port) : to_("localhost", std::stoi(port)) {
    for (const char* bone : {"Head", "LeftUpperArm"})
      packets_.add("/VMC/Ext/Bone/Pos", "sfffffff", {bone});
    packets_.add("/VMC/Ext/OK", "i");
    packets_.add("/VMC/Ext/T", "f");
  }
  void send(int frame) {
    const float turn = 0.01F * static_cast<float>(frame % 50);
    packets_.set(std::vector<float>{0, 0, 0, turn, 0, 0, 1, 0, 0, 0, 0, turn, 0, 1, 1,
                                    static_cast<float>(frame) / 60});
    for (const auto& packet : packets_.packets()) to_.send(packet.bytes());
  }
  void run(double seconds) {
    for (int frame = 0; frame < 60 * seconds; ++frame) {
      send(frame);
      std::this_thread::sleep_for(std::chrono::microseconds(16667));
    }
  }

 private:
  osc::Destination to_;
  osc::PacketSequence packets_;
};

TEST(StreamAndListen, a_stream_without_hips_is_refused_with_the_bones_that_came) {
  const TestFolder folder;
  const std::string port = free_port();
  std::thread sender([&] { NoHips(port).run(2.5); });
  const ToolRun run = run_tool({"listen", port, "-o", folder / "a.bvh", "--seconds", "2"});
  sender.join();
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("expected the bone Hips"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("Head, LeftUpperArm (form vmc)"), std::string::npos) << run.err;
}

TEST(StreamAndListen, without_a_file_it_says_who_sends_what_and_how_evenly) {
  const std::string port = free_port();
  std::thread sender([&] { NoHips(port).run(3.5); });
  const ToolRun run = run_tool({"listen", port, "--seconds", "3.2"});
  sender.join();
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("vmc: Head, LeftUpperArm\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find(" a second, 95 % of the gaps below"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("2 bones; no Hips"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("no legs"), std::string::npos) << run.out;
  const ToolRun silent = run_tool({"listen", free_port(), "--seconds", "2.2"});
  EXPECT_NE(silent.out.find("nothing comes"), std::string::npos) << silent.out;
}

TEST(StreamAndListen, end_cleanly_when_they_are_interrupted) {
  const TestFolder folder;
  const std::string walk = written_walk(folder);
  const std::string tool = GAIT_TOOL, port = free_port();
  // timeout hands on the program's own code, and in the foreground it interrupts once, not twice.
  const auto interrupted = [&](const std::string& seconds, const std::string& words) {
    return std::system(("timeout --foreground --preserve-status -s INT " + seconds + " '" + tool +
                        "' " + words + " >/dev/null 2>&1")
                           .c_str());
  };
  int listened = -1;
  std::thread listener([&] {
    listened = interrupted("4", "listen " + port + " -o '" + (folder / "out.bvh") + "'");
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(interrupted("2", "stream '" + walk + "' --to localhost:" + port + " --loop"), 0);
  listener.join();
  EXPECT_EQ(listened, 0);
  EXPECT_GT(read(folder / "out.bvh").frames(), 5);
}

}  // namespace
}  // namespace gait::testing

#endif
