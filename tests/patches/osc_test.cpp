// [gait.osc] in Pd, in real time, with real sockets: what comes over the network is recognised as
// what is read from a file, at once, and whatever strangers send, the sound goes on.
#include <gtest/gtest.h>

#ifdef GAIT_TESTS_OSC

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <thread>

#include "gait/files/bvh.h"
#include "gait/osc/destination.h"
#include "gait/osc/live_body.h"
#include "gait/osc/receiver.h"
#include "osc/bad_packets.h"
#include "osc/strange_sender.h"
#include "patches/viterbi_patch.h"

namespace gait::testing {
namespace {

// A port that nobody has just now.
int free_port() { return osc::Receiver({.port = 0}).port(); }

double now() { return osc::Receiver::now(); }
void wait_until(double time) {
  std::this_thread::sleep_for(std::chrono::duration<double>(time - now()));
}

// How long a test that is about time goes on: seconds by the environment, or a few.
double seconds_of_test(double usual) {
  const char* asked = std::getenv("GAIT_SOAK_SECONDS");
  return asked ? std::atof(asked) : usual;
}

// A patch with [gait.osc] that listens, and messages from outside while it runs.
class LivePatch : public Patch {
 public:
  const int port = free_port();
  int model, osc, told;  // the box, and a [route] to add words to: `ticks` and `quit` are there

  explicit LivePatch(const std::string& flags = "")
      : remote_port_(free_port()), remote_("127.0.0.1", remote_port_) {
    model = object("gait.model gait-demo -blocking");
    osc = object("gait.osc gait-demo" + flags + " -blocking");
    record(osc, 2, "info");
    at_start({"listen " + std::to_string(port), "dump"}, osc);
    const int remote = object("netreceive -u " + std::to_string(remote_port_));
    told = object("route quit ticks model");
    connect(remote, 0, told);
    connect(told, 0, message("; pd quit 0"));
    connect(told, 2, model);
    connect(told, 3, osc);
  }
  // Says it to [gait.osc], from outside Pd.
  void tell(const std::string& message) const {
    const std::string text = message + ";\n";
    remote_.send(std::as_bytes(std::span(text)));
  }
  // Runs it while the world does this, and then ends it.
  PdRun run(const std::function<void(const PdRun&)>& world, RunOptions options = {}) const {
    options.meanwhile = [&](const PdRun& running) {
      EXPECT_TRUE(running.wait_for("info", "listen"));
      world(running);
      wait_until(now() + 0.1);
      tell("quit");
    };
    PdRun run = run_pd(*this, options);
    EXPECT_EQ(run.exit_code, 0) << run.log;
    return run;
  }

 private:
  int remote_port_;
  osc::Destination remote_;
};

void send(const osc::Destination& to, const osc::PacketSequence& packets) {
  for (const auto& packet : packets.packets()) EXPECT_TRUE(to.send(packet.bytes()));
}

// Numbers after the last line that begins with these words.
std::vector<double> last(const PdRun& run, const std::string& name, const std::string& words) {
  std::vector<double> numbers;
  for (const std::string& line : run.recorded(name)) {
    if (!line.starts_with(words + " ")) continue;
    std::istringstream rest(line.substr(words.size()));
    numbers.clear();
    for (double number; rest >> number;) numbers.push_back(number);
  }
  return numbers;
}

int count(const PdRun& run, const std::string& name, const std::string& words) {
  const auto lines = run.recorded(name);
  return static_cast<int>(std::ranges::count_if(
      lines, [&](const std::string& line) { return line.starts_with(words); }));
}

TEST(Osc, a_strange_rig_decides_as_its_file_does_after_calibration) {
  GAIT_NEEDS_PD();
  const CorpusWalk walk = unseen_walk("sad", 4);
  const Eigen::MatrixXf inputs = inputs_of(walk);
  const Computed file = computed(inputs, 1);
  LivePatch patch;
  const int frames = patch.object("recorder frames"),
            viterbi = patch.object("gait.viterbi~ gait-demo");
  patch.connect(patch.osc, 0, frames);
  patch.connect(patch.osc, 0, viterbi);
  patch.connect(viterbi, 5, frames);
  const HumanoidBody body = osc::humanoid_of(*demo()->body);
  const StrangeSender sender(7);
  const PdRun run = patch.run([&](const PdRun&) {
    const osc::Destination to("127.0.0.1", patch.port);
    double at = now();
    for (int i = 0; i < 30; ++i, wait_until(at += 1 / 30.0)) {
      if (i == 10) patch.tell("calibrate t");
      send(to, sender.packets(standing_pose(body, CalibrationPose::t)));
    }
    wait_until(at += 1.5);  // who comes back begins anew
    for (const HumanoidPose& pose : humanoid_poses(walk.clip, body)) {
      send(to, sender.packets(pose));
      wait_until(at += 1 / 30.0);
    }
  });
  EXPECT_TRUE(run.errors().empty()) << run.log;
  // Each frame's decision is the last one that is said before the next frame.
  std::vector<std::string> decided;
  for (const std::string& line : run.recorded("frames")) {
    if (line.starts_with("in ")) decided.emplace_back();
    if (line.starts_with("state ") && !decided.empty())
      decided.back() = line.substr(6, line.find(' ', 6) - 6);
  }
  ASSERT_EQ(decided.size(), 30u + file.decisions.size());
  decided.erase(decided.begin(), decided.begin() + 30);
  int same = 0;
  for (std::size_t i = 0; i < decided.size(); ++i) {
    if (decided[i].empty() && i > 0) decided[i] = decided[i - 1];
    same += decided[i] == demo()->labels[file.decisions[i].label].name ? 1 : 0;
  }
  std::printf("%d of %d frames decided as in the file\n", same, static_cast<int>(decided.size()));
  EXPECT_GE(same, 0.98 * static_cast<double>(decided.size()));
  const auto form = run.recorded("info");
  EXPECT_NE(std::ranges::find(form, "form vmc"), form.end());
  EXPECT_EQ(count(run, "info", "stream 1"), 2);
  EXPECT_EQ(count(run, "info", "stream 0"), 1);
}

// A suit with fingers: all of Unity's bones and hair besides, sixty in all.
class FullSuit {
 public:
  FullSuit() {
    packets_.add("/VMC/Ext/Root/Pos", "sfffffff", {"root"});
    for (int bone = 0; bone < humanoid_bones; ++bone)
      packets_.add("/VMC/Ext/Bone/Pos", "sfffffff", {std::string(bone_name(bone))});
    for (int hair = humanoid_bones; hair < 60; ++hair)
      packets_.add("/VMC/Ext/Bone/Pos", "sfffffff", {"Hair" + std::to_string(hair)});
    packets_.add("/VMC/Ext/OK", "i");
    packets_.add("/VMC/Ext/T", "f");
    numbers_.resize(static_cast<std::size_t>(packets_.numbers()));
  }
  // The hips are `along` metres down the stage.
  void send(const HumanoidPose& pose, float along, double time, const osc::Destination& to) {
    std::size_t at = 0;
    const auto add = [&](const Eigen::Vector3d& place, const Eigen::Quaterniond& rotation) {
      const Eigen::Quaterniond q = mirrored(rotation);
      for (const double x : {place.x(), place.y(), place.z(), q.x(), q.y(), q.z(), q.w()})
        numbers_[at++] = static_cast<float>(x);
    };
    add({0, 0, 0}, Eigen::Quaterniond::Identity());
    for (int bone = 0; bone < 60; ++bone) {
      const Eigen::Vector3d place(0, bone == 0 ? 0.9 : 0, bone == 0 ? double{along} : 0);
      if (bone >= humanoid_bones || !pose.turned[static_cast<std::size_t>(bone)]) {
        add(place, Eigen::Quaterniond::Identity());
        continue;
      }
      add(place, pose.local_turn(bone));
    }
    numbers_[at++] = 1;
    numbers_[at++] = static_cast<float>(time);
    packets_.set(numbers_);
    testing::send(to, packets_);
  }

 private:
  osc::PacketSequence packets_;
  std::vector<float> numbers_;
};

double percentile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values.empty()
             ? 0
             : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

// In at 120 fps, as it came and as it was reconstructed out again. GAIT_SOAK_SECONDS=600 makes ten
// minutes of it.
TEST(Osc, sixty_bones_go_in_and_out_without_loss_or_delay_or_growth) {
  GAIT_NEEDS_PD();
  const double seconds = seconds_of_test(5);
  LivePatch patch;
  const int back = free_port(), legs = free_port();
  // As it came, at once.
  const int echo = patch.object("gait.osc gait-demo -blocking");
  patch.connect(patch.osc, 1, echo);
  patch.at_start({"to localhost " + std::to_string(back) + " gait"}, echo);
  const int viterbi = patch.object("gait.viterbi~ gait-demo"),
            map = patch.object("gait.map gait-demo"), synth = patch.object("gait.synth gait-demo"),
            skeleton = patch.object("gait.skeleton gait-demo"),
            avatar = patch.object("gait.osc gait-demo -blocking");
  patch.connect(patch.osc, 0, skeleton, 1);
  patch.connect(patch.osc, 0, viterbi);
  patch.connect(viterbi, 4, map);
  patch.connect(map, 0, synth);
  patch.connect(synth, 0, skeleton);
  patch.connect(skeleton, 1, avatar);
  patch.at_start({"to localhost " + std::to_string(legs) + " vmc"}, avatar);
  patch.dsp();
  const int begin = patch.object("loadbang");
  for (const auto& [ms, on] : {std::pair(2500.0, "1"), std::pair(1000 * seconds, "0")}) {
    const int later = patch.object("del " + std::to_string(ms)), number = patch.message(on);
    patch.connect(begin, 0, later);
    patch.connect(later, 0, number);
    if (can_watch()) patch.connect(number, 0, patch.object("watch"));
  }
  const int frames = static_cast<int>(seconds * 120);
  std::vector<double> sent(static_cast<std::size_t>(frames), 0), latency;
  std::vector<bool> seen(sent.size(), false);
  int walked = 0;
  double first_memory = 0, last_memory = 0;
  const auto world = [&](const PdRun& running) {
    osc::Receiver hear_back({.port = back}), hear_legs({.port = legs});
    const auto listen = [&] {
      osc::MocapEvent event;
      while (hear_back.pop(event)) {
        if (event.kind != osc::MocapKind::root) continue;
        const auto which = static_cast<std::size_t>(std::lround(event.place[2] * 1000));
        if (which >= sent.size()) continue;
        seen[which] = true;
        latency.push_back(1000 * (event.time - sent[which]));
      }
      while (hear_legs.pop(event))
        walked += event.kind == osc::MocapKind::bone && event.bone == index_of(Bone::hips) ? 1 : 0;
    };
    const HumanoidBody body = osc::humanoid_of(*demo()->body);
    const auto poses = humanoid_poses(unseen_walk("proud", 3).clip, body);
    const osc::Destination to("127.0.0.1", patch.port);
    FullSuit suit;
    const double start = now();
    for (int i = 0; i < frames; ++i) {
      const auto which = static_cast<std::size_t>(i);
      sent[which] = now();
      suit.send(poses[which / 4 % poses.size()], static_cast<float>(i) / 1000, i / 120.0, to);
      wait_until(start + (i + 1) / 120.0);
      listen();
      if (i == frames / 3) first_memory = running.megabytes();
    }
    wait_until(now() + 0.3);
    listen();
    last_memory = running.megabytes();
    patch.tell("perf");
  };
  const PdRun run = patch.run(world, {.watched = can_watch(), .at_most = seconds + 60});
  EXPECT_TRUE(run.errors().empty()) << run.log;
  const auto inside = last(run, "info", "latency");
  ASSERT_EQ(inside.size(), 4u);
  std::printf(
      "%.0f s: out again after %.2f ms (p99 %.2f, max %.2f), left the box after %.2f ms "
      "(p99 %.2f, max %.2f); %.1f to %.1f MB\n",
      seconds, percentile(latency, 0.5), percentile(latency, 0.99), percentile(latency, 1),
      inside[0], inside[1], inside[2], first_memory, last_memory);
  EXPECT_EQ(std::ranges::count(seen, true), frames);
  EXPECT_EQ(inside[3], frames);
  EXPECT_EQ(count(run, "info", "dropped"), 0);
  EXPECT_NEAR(walked, frames / 4, 8);  // the model's 30 fps
  EXPECT_GT(first_memory, 1);
  if (can_watch()) {  // a sanitizer keeps what is freed for a while
    EXPECT_LT(last_memory, first_memory + 1);
    EXPECT_EQ(watched_allocations(run), 0) << run.log;
  }
}

// A wireless network may hand over what it held back all at once.
TEST(Osc, frames_that_come_in_one_burst_are_all_taken_one_after_another) {
  GAIT_NEEDS_PD();
  LivePatch patch;
  patch.record(patch.osc, 0, "in");
  const int viterbi = patch.object("gait.viterbi~ gait-demo");
  patch.connect(patch.osc, 0, viterbi);
  patch.record(viterbi, 5, "seen");
  const PdRun run = patch.run([&](const PdRun&) {
    const HumanoidBody body = osc::humanoid_of(*demo()->body);
    const auto poses = humanoid_poses(unseen_walk("cool", 3).clip, body);
    const osc::Destination to("127.0.0.1", patch.port);
    FullSuit suit;
    for (std::size_t frame = 0; frame < 60; ++frame) {
      suit.send(poses[frame], 0, 0, to);
      if (frame % 4 == 3) wait_until(now() + 4 / 30.0);
    }
  });
  EXPECT_TRUE(run.errors().empty()) << run.log;
  EXPECT_EQ(count(run, "in", "in "), 60);
  EXPECT_NEAR(count(run, "seen", "state "), 60, 5);
}

TEST(Osc, twenty_performers_are_told_apart_and_none_loses_a_frame) {
  GAIT_NEEDS_PD();
  constexpr int performers = 20;
  const double seconds = seconds_of_test(2);
  LivePatch patch(" -poly 20");
  const int counts = patch.object("route " + [] {
    std::string numbers;
    for (int i = 0; i < performers; ++i) numbers += " " + std::to_string(i);
    return numbers;
  }());
  patch.connect(patch.osc, 0, counts);
  for (int i = 0; i < performers; ++i) patch.record(counts, i, "performer" + std::to_string(i));
  const int frames = static_cast<int>(seconds * 60);
  const PdRun run = patch.run(
      [&](const PdRun&) {
        const HumanoidBody body = osc::humanoid_of(*demo()->body);
        const auto poses = humanoid_poses(unseen_walk("cool", 3).clip, body);
        std::vector<std::unique_ptr<osc::Destination>> to;
        std::vector<osc::HumanoidSender> suits;
        std::vector<int> bones;
        for (int bone = 0; bone < main_bones; ++bone)
          if (poses[0].turned[static_cast<std::size_t>(bone)]) bones.push_back(bone);
        for (int i = 0; i < performers; ++i) {
          to.push_back(std::make_unique<osc::Destination>("127.0.0.1", patch.port));
          suits.emplace_back(osc::MocapForm::vmc, bones);
        }
        const double start = now();
        for (int frame = 0; frame < frames; ++frame) {
          for (std::size_t i = 0; i < to.size(); ++i) {
            const auto& pose = poses[(static_cast<std::size_t>(frame) / 2 + 7 * i) % poses.size()];
            suits[i].pack(pose, frame / 60.0, frame);
            for (const auto& packet : suits[i].packets()) to[i]->send(packet.bytes());
          }
          wait_until(start + (frame + 1) / 60.0);
        }
        wait_until(now() + 0.2);
        patch.tell("perf");
      },
      {.at_most = seconds + 60});
  EXPECT_TRUE(run.errors().empty()) << run.log;
  for (int i = 0; i < performers; ++i)
    EXPECT_EQ(count(run, "performer" + std::to_string(i), "in "), frames) << i;
  EXPECT_EQ(count(run, "info", "dropped"), 0);
  EXPECT_EQ(count(run, "info", "performer"), performers);
  const auto perf = last(run, "info", "perf"), latency = last(run, "info", "latency");
  ASSERT_EQ(perf.size(), 4u);
  std::printf("%d performers at 60 fps: %.1f us a frame, latency %.2f ms (p99 %.2f)\n", performers,
              perf[0], latency[0], latency[1]);
}

// Two hundred thousand packets a second, honest and broken, from this machine to itself, for as
// long as the test lasts; a performer dances on in the middle of it.
TEST(Osc, a_flood_is_dropped_and_told_once_a_second_while_the_sound_goes_on) {
  GAIT_NEEDS_PD();
  const double seconds = std::min(10.0, seconds_of_test(2));
  LivePatch patch(" -poly 2");
  const int ticks = patch.object("ticks~");
  patch.connect(patch.told, 1, ticks);
  patch.dsp();
  patch.record(patch.osc, 0, "in");
  double listened = 0, before = 0, after = 0;
  int sent = 0;
  std::size_t frames_before = 0, frames_after = 0;
  const PdRun run = patch.run([&](const PdRun& running) {
    const HumanoidBody body = osc::humanoid_of(*demo()->body);
    const HumanoidPose pose = standing_pose(body, CalibrationPose::t);
    const osc::Destination to("127.0.0.1", patch.port), mob("127.0.0.1", patch.port);
    FullSuit suit;
    const auto dance = [&](int frames) {
      for (int i = 0; i < frames; ++i) {
        suit.send(pose, 0, 0, to);
        wait_until(now() + 1 / 60.0);
      }
    };
    dance(30);
    before = running.megabytes();
    patch.tell("ticks 0");
    const double start = now();
    std::thread flood([&] {
      const std::vector<Packet> honest = honest_packets();
      std::mt19937 random(5);
      std::vector<Packet> packets;
      for (int i = 0; i < 4000; ++i)
        packets.push_back(i % 2 ? honest[random() % honest.size()] : mutated(honest, random));
      while (now() < start + seconds && sent < 200000 * seconds) {
        // No more than two hundred thousand a second, in bursts.
        while (sent > 200000 * (now() - start)) std::this_thread::yield();
        mob.send(packets[static_cast<std::size_t>(sent++) % packets.size()]);
      }
    });
    while (now() < start + seconds) dance(1);
    flood.join();
    patch.tell("ticks bang");
    listened = now() - start;
    wait_until(now() + 0.5);
    after = running.megabytes();
    frames_before = running.recorded("in").size();
    dance(30);
    wait_until(now() + 0.2);
    frames_after = running.recorded("in").size();
    patch.tell("print");
  });
  double mean = 0, longest = 0;
  int blocks = 0;
  const std::size_t at = run.log.find("ticks: ");
  ASSERT_NE(at, std::string::npos) << run.log;
  ASSERT_EQ(std::sscanf(run.log.c_str() + at, "ticks: %lf %lf %d", &mean, &longest, &blocks), 3);
  const std::size_t printed = run.log.rfind("packets");
  const int said = count(run, "info", "dropped");
  std::printf(
      "%d packets in %.1f s (%.0f a second): mean tick %.0f us, longest %.0f us, %.1f %% of "
      "the blocks that were due; %.1f to %.1f MB; told %d times\n%s\n",
      sent, seconds, sent / seconds, mean, longest, 100 * blocks / (750 * listened), before, after,
      said, run.log.substr(run.log.rfind('\n', printed) + 1).c_str());
  EXPECT_GT(blocks, 0.8 * 750 * listened);  // tests run beside other tests
  if (can_watch()) {
    EXPECT_LT(after, before + 8);
  }
  EXPECT_GE(said, 1);
  EXPECT_LE(said, seconds + 2);
  EXPECT_GE(run.errors().size(), 1u);
  EXPECT_LE(static_cast<double>(run.errors().size()), seconds + 2) << run.log;
  EXPECT_GE(frames_after, frames_before + 28);
}

// Whoever stood in a T-pose before the show need not do so again when a model is learnt in it.
TEST(Osc, a_new_model_finds_performers_calibrated_and_what_was_masked_masked) {
  GAIT_NEEDS_PD();
  LivePatch patch;
  patch.record(patch.osc, 0, "in");
  const HumanoidBody body = osc::humanoid_of(*demo()->body);
  const CorpusWalk walk = unseen_walk("cool", 2);
  const Eigen::MatrixXf inputs = inputs_of(walk);
  const PdRun run = patch.run([&](const PdRun& running) {
    const osc::Destination to("127.0.0.1", patch.port);
    const StrangeSender sender(5);
    patch.tell("hold 0.1");
    for (int i = 0; i < 20; ++i) {
      if (i == 10) patch.tell("calibrate t");
      send(to, sender.packets(standing_pose(body, CalibrationPose::t)));
      wait_until(now() + 1 / 30.0);
    }
    const auto poses = humanoid_poses(walk.clip, body);
    for (int i = 0; i < 6; ++i) {
      HumanoidPose pose = poses[0];
      pose.turned.reset(index_of(Bone::left_lower_arm));
      send(to, sender.packets(pose));
      wait_until(now() + 1 / 30.0);
    }
    EXPECT_TRUE(running.wait_for("in", "mask LeftForeArm 0"));
    patch.tell("model read " GAIT_PD_FOLDER "/gait-demo.gait");
    EXPECT_TRUE(running.wait_for("info", "ready"));
    for (std::size_t i = 0; i < 20; ++i) {
      send(to, sender.packets(poses[i]));
      wait_until(now() + 1 / 30.0);
    }
  });
  EXPECT_TRUE(run.errors().empty()) << run.log;
  EXPECT_EQ(count(run, "info", "ready"), 1);
  EXPECT_EQ(count(run, "in", "mask LeftForeArm 0"), 1);
  EXPECT_EQ(count(run, "in", "mask LeftForeArm 1"), 1);
  const auto heard = run.numbers("in", "in");
  ASSERT_EQ(heard.size(), 46u);
  for (std::size_t frame = 0; frame < 20; ++frame)
    for (int i = 0; i < inputs.rows(); ++i)
      ASSERT_NEAR(heard[26 + frame][static_cast<std::size_t>(i)],
                  inputs(i, static_cast<Eigen::Index>(frame)), 1e-3)
          << frame << " " << i;
}

TEST(Osc, each_performer_has_a_calibration_and_avatars_of_his_own) {
  GAIT_NEEDS_PD();
  LivePatch patch(" -poly 2");
  patch.record(patch.osc, 0, "in");
  const int port = free_port();
  patch.connect(patch.osc, 1, patch.osc);  // bodies go out as they came
  const HumanoidBody body = osc::humanoid_of(*demo()->body);
  int heard[2] = {0, 0};
  const PdRun run = patch.run([&](const PdRun& running) {
    osc::Receiver avatar({.port = port});
    patch.tell("list 1 to localhost " + std::to_string(port) + " gait");
    patch.tell("list 0 calibrate t");  // nobody is there
    wait_until(now() + 0.3);
    FullSuit suit;
    const osc::Destination first("127.0.0.1", patch.port), second("127.0.0.1", patch.port);
    const HumanoidPose pose = standing_pose(body, CalibrationPose::t);
    for (int i = 0; i < 10; ++i) {
      suit.send(pose, 0.1F, 0, first);
      suit.send(pose, 0.7F, 0, second);
      wait_until(now() + 1 / 30.0);
    }
    patch.tell("list 0 calibrate t");
    patch.tell("close");
    EXPECT_TRUE(running.wait_for("info", "list 1 stream 0"));
    osc::MocapEvent event;
    while (avatar.pop(event))
      if (event.kind == osc::MocapKind::root) ++heard[event.place[2] > 0.5F ? 1 : 0];
  });
  ASSERT_EQ(run.errors().size(), 1u) << run.log;
  EXPECT_NE(run.errors()[0].find("nobody sends"), std::string::npos) << run.log;
  EXPECT_EQ(heard[0], 0);
  EXPECT_EQ(heard[1], 10);
  EXPECT_EQ(count(run, "info", "list 0 stream 0"), 1);
}

TEST(Osc, a_bone_that_stops_is_masked_when_its_frame_is_due_and_taken_in_again) {
  GAIT_NEEDS_PD();
  LivePatch patch;
  patch.record(patch.osc, 0, "in");
  const HumanoidBody body = osc::humanoid_of(*demo()->body);
  const PdRun run = patch.run([&](const PdRun&) {
    const osc::Destination to("127.0.0.1", patch.port);
    const StrangeSender sender(2);
    patch.tell("hold 0.2");
    patch.tell("jitter 60");
    const auto poses = humanoid_poses(unseen_walk("cool", 4).clip, body);
    for (std::size_t frame = 0; frame < 70; ++frame) {
      HumanoidPose pose = poses[frame];
      if (frame >= 20 && frame < 40) pose.turned.reset(index_of(Bone::left_lower_arm));
      send(to, sender.packets(pose));
      wait_until(now() + 1 / 30.0);
    }
    wait_until(now() + 0.2);
  });
  EXPECT_TRUE(run.errors().empty()) << run.log;
  int frame = 0;
  std::map<std::string, int> masked;
  for (const std::string& line : run.recorded("in")) {
    if (line.starts_with("in ")) ++frame;
    if (line.starts_with("mask ")) masked[line.substr(5)] = frame;
  }
  EXPECT_EQ(frame, 70);
  ASSERT_EQ(masked.size(), 2u);
  EXPECT_NEAR(masked["LeftForeArm 0"], 20 + 0.2 * 30, 2);
  EXPECT_EQ(masked["LeftForeArm 1"], 40);
}

TEST(Osc, takes_what_other_programs_send_and_finds_out_which_form_it_is) {
  GAIT_NEEDS_PD();
  if (std::system("command -v oscsend >/dev/null") != 0)
    GTEST_SKIP() << "there is no oscsend here (Debian: liblo-tools)";
  LivePatch patch;
  patch.record(patch.osc, 0, "in");
  const int values = demo()->input.values;
  const PdRun run = patch.run([&](const PdRun&) {
    std::string numbers, types;
    for (int i = 0; i < values; ++i) {
      numbers += " " + std::to_string(0.01 * i);
      types += "f";
    }
    const std::string to = "oscsend localhost " + std::to_string(patch.port);
    EXPECT_EQ(std::system((to + " /gait/frame " + types + numbers).c_str()), 0);
    wait_until(now() + 1.2);  // each oscsend is another sender, and there is room for one
    EXPECT_EQ(std::system((to + " /gait/frame fff 1 2 3").c_str()), 0);     // of another model
    EXPECT_EQ(std::system((to + " /gait/frame s no").c_str()), 0);          // of another type
    EXPECT_EQ(std::system((to + " /somebody/else iis 1 2 x").c_str()), 0);  // not ours
    wait_until(now() + 1.3);
  });
  const auto frames = run.numbers("in", "in");
  ASSERT_EQ(frames.size(), 1u) << run.log;
  ASSERT_EQ(frames[0].size(), static_cast<std::size_t>(values));
  for (int i = 0; i < values; ++i)
    EXPECT_NEAR(frames[0][static_cast<std::size_t>(i)], 0.01 * i, 1e-6);
  const auto info = run.recorded("info");
  EXPECT_NE(std::ranges::find(info, "form gait"), info.end());
  EXPECT_EQ(last(run, "info", "dropped"), std::vector<double>{2});
  EXPECT_EQ(run.errors().size(), 1u) << run.log;
}

// Steps decided of a walk whose packets a network holds back for `held` seconds of every second.
int steps_decided(double held, double jitter) {
  LivePatch patch;
  const int viterbi = patch.object("gait.viterbi~ gait-demo");
  patch.connect(patch.osc, 0, viterbi);
  patch.record(viterbi, 5, "seen");
  patch.record(patch.osc, 0, "in");
  std::size_t sent_frames = 0;
  const PdRun run = patch.run([&](const PdRun&) {
    if (jitter > 0) patch.tell("jitter " + std::to_string(jitter));
    wait_until(now() + 0.1);
    const HumanoidBody body = osc::humanoid_of(*demo()->body);
    const auto poses = humanoid_poses(unseen_walk("proud", 7).clip, body);
    const osc::Destination to("127.0.0.1", patch.port);
    FullSuit suit;
    const double start = now();
    sent_frames = poses.size();
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
      double due = static_cast<double>(frame) / 30;
      const double in_second = std::fmod(due, 1.0);
      if (in_second > 1 - held) due += 1 - in_second;
      wait_until(start + due);
      suit.send(poses[frame], 0, static_cast<double>(frame) / 30, to);
    }
    wait_until(now() + jitter / 1000 + 0.3);
  });
  EXPECT_TRUE(run.errors().empty()) << run.log;
  EXPECT_EQ(count(run, "in", "in "), static_cast<int>(sent_frames));
  int steps = 0;
  std::string label, style;
  for (const std::string& line : run.recorded("seen")) {
    if (line.starts_with("style ")) {
      EXPECT_NE(line, style) << "told twice";
      style = line;
    }
    if (!line.starts_with("state ")) continue;
    const std::string now_label = line.substr(6, line.find(' ', 6) - 6);
    steps += now_label != label ? 1 : 0;
    label = now_label;
  }
  return steps;
}

TEST(Osc, bursts_within_the_jitter_buffer_cost_no_step) {
  GAIT_NEEDS_PD();
  const int undisturbed = steps_decided(0, 0);
  EXPECT_GE(undisturbed, 10);
  for (const double held : {0.12, 0.2, 0.3}) {
    const int steps = steps_decided(held, 1000 * held);
    std::printf("%.0f ms held each second: %d steps, undisturbed %d\n", 1000 * held, steps,
                undisturbed);
    EXPECT_NEAR(steps, undisturbed, 1) << held;
  }
}

TEST(Osc, hears_both_families_of_addresses_and_lists_and_chooses_senders) {
  GAIT_NEEDS_PD();
  LivePatch patch;
  patch.record(patch.osc, 0, "in");
  const PdRun run = patch.run([&](const PdRun& running) {
    const HumanoidPose pose = standing_pose(osc::humanoid_of(*demo()->body), CalibrationPose::t);
    const osc::Destination four("127.0.0.1", patch.port), six("::1", patch.port);
    FullSuit suit, other;
    const auto both = [&](int frames) {
      for (int i = 0; i < frames; ++i) {
        suit.send(pose, 0, 0, four);
        other.send(pose, 0, 0, six);
        wait_until(now() + 1 / 60.0);
      }
    };
    both(30);
    patch.tell("senders");
    patch.tell("from ::1");
    wait_until(now() + 0.2);
    both(10);
    patch.tell("dump");
    EXPECT_TRUE(running.wait_for("info", "from ::1"));
  });
  EXPECT_TRUE(run.errors().empty()) << run.log;
  EXPECT_EQ(count(run, "info", "sender 127.0.0.1:"), 1) << run.log;
  EXPECT_EQ(count(run, "info", "sender [::1]:"), 1);
  EXPECT_EQ(count(run, "info", "performer 0 127.0.0.1:"), 1);
  EXPECT_EQ(count(run, "info", "performer 0 [::1]:"), 1);
}

TEST(Osc, phones_reach_patches_and_takes_and_outputs_reach_wekinators_listeners) {
  GAIT_NEEDS_PD();
  LivePatch patch;
  patch.record(patch.osc, 0, "plain");
  const int train = patch.object("gait.train moves -in 3 -blocking");
  patch.connect(patch.osc, 0, train);
  patch.record(train, 1, "takes");
  patch.at_start({"record shake"}, train);
  const int port = free_port();
  std::vector<float> heard;
  const PdRun run = patch.run([&](const PdRun&) {
    osc::Receiver listener({.port = port, .form = osc::MocapForm::wekinator});
    patch.tell("to localhost " + std::to_string(port) + " wekinator");
    const osc::Destination to("127.0.0.1", patch.port);
    osc::PacketTemplate phone;
    phone.add("/ZIGSIM/a1/accel", "fff");
    for (int i = 0; i < 30; ++i) {
      phone.set(std::vector<float>{static_cast<float>(i), 1, 2});
      to.send(phone.bytes());
      wait_until(now() + 1 / 60.0);
    }
    patch.tell("outputs 0.25 0.5");
    wait_until(now() + 0.1);
    // What Wekinator's listeners get is not what Wekinator takes: read from the socket's count.
    heard.push_back(static_cast<float>(listener.received().messages));
  });
  EXPECT_TRUE(run.errors().empty()) << run.log;
  EXPECT_EQ(count(run, "plain", "plain accel "), 30);
  EXPECT_EQ(heard, std::vector<float>{1});
}

#ifdef GAIT_TOOL

// `gait stream` four times over, each time another suit.
TEST(Osc, hears_gait_stream_in_every_form_it_speaks) {
  GAIT_NEEDS_PD();
  const CorpusWalk walk = unseen_walk("cool", 2);
  const Eigen::MatrixXf inputs = inputs_of(walk);
  const std::string file = ::testing::TempDir() + "gait_streamed.bvh";
  write_bvh(bvh_from_clip(walk.clip), file);
  const std::vector<std::string> forms{"vmc", "natnet", "neuron", "gait"};
  LivePatch patch(" -poly 4");
  const int voices = patch.object("route 0 1 2 3");
  patch.connect(patch.osc, 0, voices);
  for (int i = 0; i < 4; ++i) patch.record(voices, i, "performer" + std::to_string(i));
  const PdRun run = patch.run([&](const PdRun&) {
    std::vector<std::thread> streams;
    for (const std::string& form : forms)
      streams.emplace_back([&, form] {
        EXPECT_EQ(std::system(("'" GAIT_TOOL "' stream '" + file + "' --to localhost:" +
                               std::to_string(patch.port) + " --form " + form + " >/dev/null")
                                  .c_str()),
                  0);
      });
    for (std::thread& stream : streams) stream.join();
  });
  EXPECT_TRUE(run.errors().empty()) << run.log;
  std::map<std::string, std::string> performer_of;
  for (const std::string& line : run.recorded("info"))
    for (const std::string& form : forms)
      if (line.ends_with(" form " + form)) performer_of[form] = "performer" + line.substr(5, 1);
  ASSERT_EQ(performer_of.size(), forms.size()) << run.log;
  // A busy machine may hold a sender up in the middle of a frame, which then counts as two.
  for (const std::string& form : forms)
    EXPECT_NEAR(count(run, performer_of[form], "in "), static_cast<double>(inputs.cols()), 2)
        << form;
  const auto heard = run.numbers(performer_of["gait"], "in");
  std::size_t at = 0;
  for (int frame = 0; frame < inputs.cols(); ++frame) {
    const auto same = [&](const std::vector<double>& values) {
      double worst = 0;
      for (int i = 0; i < inputs.rows(); ++i)
        worst = std::max(worst, std::abs(values[static_cast<std::size_t>(i)] -
                                         static_cast<double>(inputs(i, frame))));
      return worst < 1e-3;
    };
    while (at < heard.size() && !same(heard[at])) ++at;
    ASSERT_LT(at, heard.size()) << "frame " << frame << " was not heard, or too late";
  }
}

#endif

TEST(Osc, what_it_cannot_do_is_said_in_a_line_and_nothing_changes) {
  GAIT_NEEDS_PD();
  LivePatch patch;
  patch.record(patch.osc, 0, "in");
  const osc::Receiver taken({.port = 0});
  const std::string busy = std::to_string(taken.port());
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"listen 0", "65535"},
      {"listen " + busy, "is taken by another program"},
      {"listen 39540 fax", "any, or a form"},
      {"to localhost 39539 fax", "wekinator for"},
      {"to no.such.host.invalid 39539", "no host of that name"},
      {"calibrate x", "t or i"},
      {"yaw north", "yaw"},
      {"jitter -1", "jitter"},
      {"hold 0", "hold"},
      {"pose 1 2 3", "expected"},
      {"dance", "no such message"}};
  const PdRun run = patch.run([&](const PdRun& running) {
    for (const auto& [message, words] : wrong) patch.tell(message);
    wait_until(now() + 0.3);
    std::string long_name(10000, 'x');
    osc::PacketTemplate packet;
    packet.add("/VMC/Ext/Bone/Pos", "sfffffff", {long_name});
    packet.set(std::vector<float>{0, 0, 0, 0, 0, 0, 1});
    const osc::Destination to("127.0.0.1", patch.port);
    to.send(packet.bytes());
    FullSuit suit;
    suit.send(standing_pose(osc::humanoid_of(*demo()->body), CalibrationPose::t), 0, 0, to);
    EXPECT_TRUE(running.wait_for("in", "in "));
    patch.tell("dump");
    wait_until(now() + 0.1);
  });
  const auto errors = run.errors();
  EXPECT_EQ(errors.size(), wrong.size()) << run.log;
  for (const auto& [message, words] : wrong)
    EXPECT_TRUE(std::ranges::any_of(errors,
                                    [&, &words = words](const std::string& line) {
                                      return line.find("gait.osc: ") != std::string::npos &&
                                             line.find(words) != std::string::npos;
                                    }))
        << message << "\n"
        << run.log;
  EXPECT_EQ(last(run, "info", "listen"), std::vector<double>{static_cast<double>(patch.port)});
  EXPECT_EQ(last(run, "info", "yaw"), std::vector<double>{0});
  EXPECT_EQ(count(run, "in", "in "), 1);
}

}  // namespace
}  // namespace gait::testing

#endif
