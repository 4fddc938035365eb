// Who is taken of several senders, and where their frames end.
#include <gtest/gtest.h>

#include "gait/osc/forms.h"
#include "gait/osc/humanoid_sender.h"
#include "gait/osc/natnet_names.h"
#include "osc/captured.h"

namespace gait::testing {
namespace {

using osc::MocapForm;

const std::vector<int> face{index_of(Bone::neck), index_of(Bone::head)};

std::vector<int> body() {
  std::vector<int> bones;
  for (int bone = 0; bone < main_bones; ++bone) bones.push_back(bone);
  return bones;
}

// A program that sends frames in a form.
class Program {
 public:
  Program(Listened& to, const UdpAddress& from, const std::vector<int>& bones,
          MocapForm form = MocapForm::vmc)
      : to_(to), address(from), sender_(form, bones) {
    pose_.turned.set();
  }
  void frame(double time) {
    sender_.pack(pose_, time, count_++);
    to_.hear_all(sender_.packets(), time, address);
  }
  void frames(double from, double to, double rate = 60) {
    for (double time = from; time < to; time += 1 / rate) frame(time);
  }

 private:
  Listened& to_;

 public:
  UdpAddress address;

 private:
  osc::HumanoidSender sender_;
  HumanoidPose pose_;
  int count_ = 0;
};

// Whose frames the performer had, without repetitions.
std::vector<UdpAddress> senders_of(const Listened& listened, int performer = 0) {
  std::vector<UdpAddress> senders;
  for (std::size_t i = 0; i < listened.frames.size(); ++i)
    if (listened.performers[i] == performer &&
        (senders.empty() || !(senders.back() == listened.frames[i].sender)))
      senders.push_back(listened.frames[i].sender);
  return senders;
}

const UdpAddress a = Listened::machine(1, 5000), b = Listened::machine(2, 6000);

TEST(Senders, a_body_beats_a_face_in_both_orders) {
  for (const bool face_first : {true, false}) {
    Listened listened;
    Program mask(listened, a, face), suit(listened, b, body());
    for (int i = 0; i < 120; ++i) {
      const double time = i / 60.0;
      if (face_first || time > 0.5) mask.frame(time);
      if (!face_first || time > 0.5) suit.frame(time + 0.003);
    }
    const auto senders = senders_of(listened);
    EXPECT_EQ(senders.back(), b);
    EXPECT_EQ(senders.size(), face_first ? 2u : 1u);
    if (face_first) {
      // At its first frame.
      const auto first = std::ranges::find(listened.frames, b, &osc::CapturedFrame::sender);
      EXPECT_LT(first->time, 0.53);
    }
  }
}

TEST(Senders, the_first_of_two_suits_stays) {
  Listened listened;
  Program first(listened, a, body()), second(listened, b, body());
  for (int i = 0; i < 300; ++i) {
    if (i < 100 || i > 118) first.frame(i / 60.0);  // 0.3 s away
    if (i > 20) second.frame(i / 60.0 + 0.004);
  }
  EXPECT_EQ(senders_of(listened), std::vector{a});
  EXPECT_GT(listened.gatherer.left_out(), 200u);
}

TEST(Senders, a_chosen_one_is_the_only_one_taken) {
  Listened listened;
  Program first(listened, a, body()), second(listened, b, body());
  listened.gatherer.choose(0, {Listened::machine(2, 0)});
  for (int i = 0; i < 20; ++i) first.frame(i / 60.0), second.frame(i / 60.0 + 0.004);
  EXPECT_EQ(senders_of(listened), std::vector{b});
  listened.gatherer.choose(0, {a});
  listened.frames.clear();
  listened.performers.clear();
  for (int i = 20; i < 40; ++i) first.frame(i / 60.0), second.frame(i / 60.0 + 0.004);
  EXPECT_EQ(senders_of(listened), std::vector{a});
  listened.gatherer.choose(0, {Listened::machine(1, 4999)});
  listened.frames.clear();
  first.frames(1, 2);
  EXPECT_TRUE(listened.frames.empty());
}

TEST(Senders, a_new_port_for_every_frame_is_one_sender) {
  Listened listened;
  Program suit(listened, a, body());
  int begun = 0;
  for (int i = 0; i < 120; ++i) {
    suit.address.port = static_cast<std::uint16_t>(40000 + i);
    suit.frame(i / 60.0);
  }
  for (const auto& frame : listened.frames) begun += frame.begun ? 1 : 0;
  EXPECT_GE(listened.frames.size(), 117u);
  EXPECT_EQ(begun, 1);
}

// Each from a port of his own, all at once.
TEST(Senders, many_on_one_machine_are_told_apart_from_the_first_frame_on) {
  Listened listened(5);
  std::vector<Program> suits;
  suits.reserve(5);
  for (std::uint16_t i = 0; i < 5; ++i)
    suits.emplace_back(listened, Listened::machine(1, 7000 + i), body());
  for (int frame = 0; frame < 60; ++frame)
    for (std::size_t i = 0; i < suits.size(); ++i)
      suits[i].frame(frame / 60.0 + 0.0005 * static_cast<double>(i));
  for (int i = 0; i < 5; ++i) EXPECT_EQ(std::ranges::count(listened.performers, i), 60) << i;
}

TEST(Senders, a_restart_on_another_port_or_in_another_form_is_taken_over_at_once) {
  for (const MocapForm form : {MocapForm::vmc, MocapForm::natnet}) {
    Listened listened;
    Program before(listened, a, body());
    before.frames(0, 1);
    Program after(listened, Listened::machine(1, 5001), body(), form);
    after.frames(1.3, 2.3);
    const auto senders = senders_of(listened);
    ASSERT_EQ(senders.size(), 2u);
    EXPECT_EQ(senders.back(), after.address);
    const auto first =
        std::ranges::find(listened.frames, after.address, &osc::CapturedFrame::sender);
    EXPECT_LT(first->time, 1.33);
    int begun = 0;
    for (const auto& frame : listened.frames) begun += frame.begun ? 1 : 0;
    EXPECT_EQ(begun, 2);
  }
}

TEST(Senders, a_bone_told_twice_replaces_and_does_not_end_the_frame) {
  Listened listened;
  const auto bone = [&](const char* name, float turn, double time) {
    listened.say("/VMC/Ext/Bone/Pos", "sfffffff", {name}, {0, 0, 0, turn, 0, 0, 1}, time);
  };
  for (int frame = 0; frame < 30; ++frame) {  // as onapose sends
    const double time = frame / 30.0;
    bone("Hips", 0, time);
    bone("LeftHand", 0.1F, time);
    bone("RightHand", 0.1F, time);
    bone("LeftHand", 0.2F, time + 0.001);
    bone("RightHand", 0.2F, time + 0.001);
    listened.say("/VMC/Ext/OK", "i", {}, {1}, time + 0.002);
    listened.say("/VMC/Ext/T", "f", {}, {static_cast<float>(time)}, time + 0.002);
  }
  ASSERT_EQ(listened.frames.size(), 30u);
  EXPECT_NEAR(listened.frames[9].rotations[index_of(Bone::left_hand)][0], 0.196, 1e-3);
  EXPECT_NEAR(listened.frames[9].sent, 9 / 30.0, 1e-6);
  EXPECT_EQ(listened.frames[9].rotated.count(), 3u);
}

// A natnet bridge tells the names of a whole rig in each naming that Motive has.
TEST(Senders, motives_names_are_understood_as_a_set_in_each_naming) {
  const std::vector<std::vector<std::string>> namings{
      {"Hip",   "Ab",    "Chest",     "Neck",  "Head",  "LShoulder", "LUArm",
       "LFArm", "LHand", "RShoulder", "RUArm", "RFArm", "RHand",     "LThigh",
       "LShin", "LFoot", "RThigh",    "RShin", "RFoot", "LToe",      "RToe"},
      {"Hips",      "Spine",       "Spine1",      "Neck",          "Head",       "LeftShoulder",
       "LeftArm",   "LeftForeArm", "LeftHand",    "RightShoulder", "RightArm",   "RightForeArm",
       "RightHand", "LeftUpLeg",   "LeftLeg",     "LeftFoot",      "RightUpLeg", "RightLeg",
       "RightFoot", "LeftToeBase", "RightToeBase"},
      {"Hips",         "Chest",     "Chest2",    "Neck",        "Head",          "LeftCollar",
       "LeftShoulder", "LeftElbow", "LeftWrist", "RightCollar", "RightShoulder", "RightElbow",
       "RightWrist",   "LeftHip",   "LeftKnee",  "LeftAnkle",   "RightHip",      "RightKnee",
       "RightAnkle",   "LeftToe",   "RightToe"}};
  const std::vector<std::string> meant{
      "Hips",          "Spine",         "Chest",         "Neck",         "Head",
      "LeftShoulder",  "LeftUpperArm",  "LeftLowerArm",  "LeftHand",     "RightShoulder",
      "RightUpperArm", "RightLowerArm", "RightHand",     "LeftUpperLeg", "LeftLowerLeg",
      "LeftFoot",      "RightUpperLeg", "RightLowerLeg", "RightFoot",    "LeftToes",
      "RightToes"};
  for (const auto& names : namings) {
    std::vector<std::string> owned;
    for (const std::string& name : names) owned.push_back("Anna_" + name);
    const std::vector<int> bones = osc::bones_of_names(owned);
    for (std::size_t i = 0; i < names.size(); ++i)
      EXPECT_EQ(bones[i] < 0 ? "none" : std::string(bone_name(bones[i])), meant[i]) << names[i];
  }
  EXPECT_EQ(osc::bones_of_names({"RThumb2"})[0], index_of(Bone::right_fingers) + 1);
}

TEST(Senders, optitrack_frames_are_as_many_with_names_as_without) {
  Listened listened;
  Program suit(listened, a, body(), MocapForm::natnet);
  suit.frames(0, 0.999);
  EXPECT_EQ(listened.frames.size(), 60u);
  for (const auto& frame : listened.frames) EXPECT_EQ(frame.rotated.count(), 22u);
  EXPECT_NEAR(listened.frames[30].sent, 500, 1);  // milliseconds
}

TEST(Senders, sparck_mode_finds_a_skeletons_names_by_its_number) {
  for (const bool called : {true, false}) {
    Listened listened;
    if (called) listened.say("/motive/skeleton/id", "si", {"Anna"}, {7});
    listened.say("/motive/skeleton/id/bone", "sis", {"Anna", "Anna_LUArm"}, {5});
    listened.say("/motive/skeleton/id/bone", "sis", {"Anna", "Anna_LShoulder"}, {4});
    if (called) listened.say("/motive/skeleton/id/bone", "sis", {"Bert", "Bert_RHand"}, {5});
    for (const int number : {4, 5})
      listened.say("/skel", "iifffffffff", {},
                   {7, static_cast<float>(number), 77, 0, 0, 0, 0, 0, 0, 1});
    std::vector<int> bones;
    for (const auto& event : listened.events) bones.push_back(event.bone);
    EXPECT_EQ(bones,
              (std::vector<int>{index_of(Bone::left_shoulder), index_of(Bone::left_upper_arm)}));
  }
}

TEST(Senders, addresses_are_written_as_people_do) {
  EXPECT_EQ(Listened::machine(7, 39540).name(), "10.0.0.7:39540");
  UdpAddress six;
  six.host[15] = 1;
  six.port = 80;
  EXPECT_EQ(six.name(), "[::1]:80");
  six.host[0] = 0xFE, six.host[1] = 0x80, six.host[9] = 0x12;
  EXPECT_EQ(six.name(), "[fe80::12:0:0:1]:80");
}

}  // namespace
}  // namespace gait::testing
