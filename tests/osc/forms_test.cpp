// Each form of live motion, message by message as its senders write it, and whole walks through
// each.
#include "gait/osc/forms.h"

#include <gtest/gtest.h>

#include "gait/corpus/corpus.h"
#include "gait/motion/humanoid_body.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"
#include "gait/osc/humanoid_sender.h"
#include "gait/osc/sender_pose.h"
#include "osc/captured.h"

namespace gait::testing {
namespace {

using osc::MocapForm;
using osc::MocapKind;

const std::vector<float> zeros(40, 0);

TEST(Forms, a_vmc_root_comes_with_eight_or_fourteen_arguments) {
  Listened listened;
  listened.say("/VMC/Ext/Root/Pos", "sfffffff", {"root"}, {1, 2, 3, 0, 0, 0, 1});
  listened.say("/VMC/Ext/Root/Pos", "sfffffffffffff", {"root"},
               {1, 2, 3, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0});
  ASSERT_EQ(listened.events.size(), 2u);
  for (const auto& event : listened.events) {
    EXPECT_EQ(event.kind, MocapKind::root);
    EXPECT_EQ(event.place, (std::array<float, 3>{1, 2, 3}));
  }
}

TEST(Forms, a_vmc_bone_is_taken_by_its_name_and_what_is_wrong_is_passed_over) {
  Listened listened;
  const std::vector<float> numbers{0, 0, 0, -0.1058F, -0.0465F, 0.0867F, 0.9895F};
  listened.say("/VMC/Ext/Bone/Pos", "sfffffff", {"RightFoot"}, numbers);
  ASSERT_EQ(listened.events.size(), 1u);
  EXPECT_EQ(listened.events[0].bone, index_of(Bone::right_foot));
  EXPECT_NEAR(listened.events[0].rotation[0], -0.1058, 1e-3);
  listened.say("/VMC/Ext/Bone/Pos", "sffffff", {"RightFoot"}, zeros);   // one too few
  listened.say("/VMC/Ext/Bone/Pos", "sfffffff", {"RightFoot"}, zeros);  // no rotation
  listened.say("/VMC/Ext/Bone/Pos", "ffffffff", {}, zeros);             // no name
  listened.say("/VMC/Ext/Bone/Pos", "sfffffff", {"RightFoot"},
               {0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0, 0, 1});
  listened.say("/VMC/Ext/Bone/Pos", "sfffffff", {std::string(10000, 'x')}, numbers);
  EXPECT_EQ(listened.faulty, 5);
  listened.say("/VMC/Ext/Blend/Val", "sf", {"Joy"}, zeros);
  listened.say("/VMC/Ext/Bone/Pos", "sfffffff", {"Tail"}, numbers);
  EXPECT_EQ(listened.unknown, 2);
  EXPECT_EQ(listened.events.size(), 1u);
}

TEST(Forms, a_natnet_bone_is_read_in_all_four_modes) {
  const std::vector<float> place{5, 0.1F, 0.2F, 0.3F}, turn{5, 0, 0, 0.6F, 0.8F};
  Listened max;
  max.say("/skeleton/bone", "sisfff", {"Anna", "position"}, place);
  max.say("/skeleton/bone", "sisffff", {"Anna", "quat"}, turn);
  max.say("/frame/end", "i", {}, {1});
  Listened isadora;
  isadora.say("/skeleton/Anna/bone/5/position", "fff", {}, {0.1F, 0.2F, 0.3F});
  isadora.say("/skeleton/Anna/bone/5/quat", "ffff", {}, {0, 0, 0.6F, 0.8F});
  isadora.say("/frame/end", "i", {}, {1});
  Listened touch;
  touch.say("/skeleton/Anna/bone/5/transformation", "fffffff", {},
            {0.1F, 0.2F, 0.3F, 0, 0, 0.6F, 0.8F});
  touch.say("/frame/end", "i", {}, {1});
  Listened sparck;
  sparck.say("/skel", "iifffffffff", {}, {1, 5, 77, 0.1F, 0.2F, 0.3F, 0, 0, 0.6F, 0.8F});
  sparck.say("/f/e", "i", {}, {1});
  for (const Listened* listened : {&max, &isadora, &touch, &sparck}) {
    ASSERT_EQ(listened->frames.size(), 1u);
    const auto& frame = listened->frames[0];
    const int head = index_of(Bone::head);  // Motive's fifth
    EXPECT_TRUE(frame.rotated[head] && frame.placed[head]);
    EXPECT_FLOAT_EQ(frame.rotations[head][2], 0.6F);
    EXPECT_FLOAT_EQ(frame.places[head][1], 0.2F);
  }
}

TEST(Forms, names_that_a_natnet_bridge_tells_replace_its_numbers) {
  Listened listened;
  listened.say("/motive/skeleton/id/bone", "sis", {"Anna", "Anna_LFArm"}, {5});
  listened.say("/skeleton/bone", "sisffff", {"Anna", "quat"}, {5, 0, 0, 0, 1});
  listened.say("/skeleton/bone", "sisffff", {"Bert", "quat"}, {5, 0, 0, 0, 1});
  ASSERT_EQ(listened.events.size(), 2u);
  EXPECT_EQ(listened.events[0].bone, index_of(Bone::left_lower_arm));
  EXPECT_EQ(listened.events[1].bone, index_of(Bone::head));
}

TEST(Forms, joints_of_neuron_have_their_places_in_the_body) {
  Listened listened;
  for (const int joint : {0, 4, 16, 17, 21, 39, 58})
    listened.say("/perception_joint", "ifffffff", {},
                 {static_cast<float>(joint), 0, 1, 0, 0, 0, 0, 1});
  listened.say("/perception_joint", "iffffff", {}, zeros);
  EXPECT_EQ(listened.faulty, 1);
  std::vector<std::string> names;
  for (const auto& event : listened.events)
    if (event.kind == MocapKind::bone) names.emplace_back(bone_name(event.bone));
  EXPECT_EQ(names,
            (std::vector<std::string>{"Hips", "LeftUpperLeg", "RightHand", "RightThumbProximal",
                                      "RightIndexProximal", "LeftHand", "LeftLittleDistal"}));
  ASSERT_EQ(listened.frames.size(), 1u);  // the last joint ends the frame
}

TEST(Forms, a_kinect_joint_that_is_not_seen_is_not_used) {
  Listened listened;
  listened.say("/joint", "siifffff", {"l_knee"}, {0, 2, 10, 20, 300, 1, 5});
  listened.say("/joint", "siifffff", {"l_knee"}, {0, 2, 0, 0, 0, 1, 5});
  listened.say("/joint", "siifffff", {"l_knee"}, {0, 2, 10, 20, 300, 0, 5});
  listened.say("/joint", "sifff", {"l_knee"}, {3, 0.5F, 0.5F, 2});
  ASSERT_EQ(listened.events.size(), 2u);
  EXPECT_EQ(listened.events[0].stream, 2u);
  EXPECT_FLOAT_EQ(listened.events[0].place[2], 3);
  EXPECT_FLOAT_EQ(listened.events[1].place[0], 0);
  EXPECT_FLOAT_EQ(listened.events[1].place[2], 2.56F);
}

TEST(Forms, a_form_that_was_named_is_the_only_one_read) {
  Listened listened(1, MocapForm::kinect);
  listened.say("/VMC/Ext/OK", "i", {}, {1});
  listened.say("/gait/joint", "sfff", {"LeftArm"}, {0, 0, 0});
  EXPECT_EQ(listened.unknown, 2);
  listened.say("/joint", "sifff", {"head"}, {1, 0.5F, 0.5F, 2});
  EXPECT_EQ(listened.events.size(), 1u);
}

TEST(Forms, a_frame_ends_where_its_sender_says_so_or_a_bone_comes_again_or_nothing_more_comes) {
  const auto bone = [](Listened& listened, const std::string& name, double time) {
    listened.say("/VMC/Ext/Bone/Pos", "sfffffff", {name}, {0, 0, 0, 0, 0, 0, 1}, time);
  };
  Listened listened;
  bone(listened, "Hips", 1);
  bone(listened, "Spine", 1.001);
  listened.say("/VMC/Ext/OK", "i", {}, {1}, 1.002);
  listened.say("/VMC/Ext/T", "f", {}, {1}, 1.002);  // ends nothing more
  EXPECT_EQ(listened.frames.size(), 1u);
  EXPECT_EQ(listened.frames[0].rotated.count(), 2u);
  EXPECT_DOUBLE_EQ(listened.frames[0].time, 1);
  bone(listened, "Hips", 3.1);  // it says so no longer
  bone(listened, "Spine", 3.101);
  bone(listened, "Spine", 3.102);  // what came first ends the frame, nothing else
  EXPECT_EQ(listened.frames.size(), 1u);
  bone(listened, "Hips", 3.2);
  EXPECT_EQ(listened.frames.size(), 2u);
  listened.gatherer.end_old(3.205, listened);
  EXPECT_EQ(listened.frames.size(), 2u);
  listened.gatherer.end_old(3.22, listened);
  EXPECT_EQ(listened.frames.size(), 3u);
}

TEST(Forms, performers_keep_their_numbers_until_they_are_silent_and_another_needs_them) {
  Listened listened(2);
  osc::PacketTemplate packet;
  packet.add("/VMC/Ext/Bone/Pos", "sfffffff", {"Hips"});
  packet.add("/VMC/Ext/OK", "i");
  packet.set(std::vector<float>{0, 0, 0, 0, 0, 0, 1, 1});
  for (const std::uint8_t sender : std::initializer_list<std::uint8_t>{7, 8, 7, 9})
    listened.hear(packet.bytes(), 1, sender);
  EXPECT_EQ(listened.performers, (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(listened.gatherer.left_out(), 1u);
  listened.hear(packet.bytes(), 2.5, 8);
  listened.hear(packet.bytes(), 2.6, 9);  // 7 has gone
  EXPECT_EQ(listened.performers.back(), 0);
}

TEST(Forms, who_was_away_finds_his_number_free_while_there_are_others) {
  Listened listened(3);
  const auto frame = [&](std::uint8_t sender, double time) {
    osc::PacketTemplate packet;
    packet.add("/VMC/Ext/Bone/Pos", "sfffffff", {"Hips"});
    packet.add("/VMC/Ext/OK", "i");
    packet.set(std::vector<float>{0, 1, 0, 0, 0, 0, 1, 1});
    listened.hear(packet.bytes(), time, sender);
    return listened.performers.back();
  };
  EXPECT_EQ(frame(1, 0), 0);
  EXPECT_EQ(frame(2, 1.5), 1);  // the first has been silent: there is room without his
  EXPECT_EQ(frame(1, 2), 0);
  EXPECT_EQ(frame(3, 2), 2);
  EXPECT_EQ(frame(2, 3.2), 1);
  EXPECT_EQ(frame(4, 4.3), 0);  // nobody's is left: who is silent for longest
}

TEST(Forms, bundles_of_the_future_are_of_now_and_deep_ones_are_not_followed) {
  Listened listened;
  osc::PacketTemplate packet;
  packet.add("/VMC/Ext/OK", "i");
  packet.add("/VMC/Ext/T", "f");
  std::vector<std::byte> bytes(packet.bytes().begin(), packet.bytes().end());
  bytes[8] = std::byte{0xFF};  // a time in the next century
  listened.hear(bytes, 0);
  EXPECT_EQ(listened.events.size(), 2u);
  for (int depth = 0; depth < 2000; ++depth) {
    std::vector<std::byte> around(packet.bytes().begin(), packet.bytes().begin() + 16);
    for (int shift = 24; shift >= 0; shift -= 8)
      around.push_back(static_cast<std::byte>(bytes.size() >> shift & 0xFF));
    around.insert(around.end(), bytes.begin(), bytes.end());
    bytes = around;
    if (depth == 3) listened.hear(bytes, 0);
  }
  EXPECT_EQ(listened.events.size(), 4u);
  EXPECT_EQ(listened.faulty, 0);
  listened.hear(bytes, 0);
  EXPECT_EQ(listened.events.size(), 4u);
  EXPECT_EQ(listened.faulty, 1);
}

// A walk told in a form and read again is the same body, turn by turn.
class WholeWalk : public ::testing::TestWithParam<MocapForm> {};

TEST_P(WholeWalk, comes_out_as_it_went_in) {
  const CorpusWalk walk = make_walk({.style = corpus_style("drunk"), .cycles = 2});
  const Clip& clip = walk.clip;
  const JointRoles roles = find_roles(clip.skeleton);
  HumanoidBody body(clip.skeleton, roles, clip.pose(0));
  const WorldPoses world = world_poses(clip);
  const auto joints = static_cast<std::size_t>(clip.skeleton.size());
  std::vector<HumanoidPose> sent;
  for (int frame = 0; frame < clip.frames(); ++frame) {
    const std::size_t at = joints * static_cast<std::size_t>(frame);
    body.read({world.rotations.data() + at, joints}, {world.positions.data() + at, joints},
              sent.emplace_back());
  }
  std::vector<int> bones;
  for (int bone = 0; bone < humanoid_bones; ++bone)
    if (sent[0].turned[bone]) bones.push_back(bone);
  ASSERT_GE(bones.size(), 16u);
  osc::HumanoidSender sender(GetParam(), bones);
  Listened listened;
  for (std::size_t frame = 0; frame < sent.size(); ++frame) {
    sender.pack(sent[frame], static_cast<double>(frame) / 30, static_cast<int>(frame));
    for (const auto& packet : sender.packets())
      EXPECT_LE(packet.size(), GetParam() < MocapForm::mocopi ? 1500u : 12000u);
    listened.hear_all(sender.packets(), static_cast<double>(frame) / 30);
  }
  listened.gatherer.end_old(1e6, listened);
  EXPECT_EQ(listened.faulty, 0);
  ASSERT_EQ(listened.frames.size(), sent.size());
  osc::SenderPose pose;
  for (std::size_t frame = 0; frame < sent.size(); ++frame) {
    ASSERT_TRUE(pose.take(listened.frames[frame]));
    for (const int bone : bones) {
      // Rokoko has one chest, which is the upper one.
      if (GetParam() == MocapForm::rokoko &&
          (bone == index_of(Bone::chest) || bone == index_of(Bone::upper_chest)))
        continue;
      EXPECT_LT(angle_between(pose.world().turns[bone], sent[frame].turns[bone]), 1e-5);
      EXPECT_LT((pose.world().places[bone] - sent[frame].places[bone]).norm(), 1e-4);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, WholeWalk,
                         ::testing::Values(MocapForm::vmc, MocapForm::natnet, MocapForm::neuron,
                                           MocapForm::mocopi, MocapForm::mvn, MocapForm::rokoko),
                         [](const auto& form) { return std::string(osc::form_name(form.param)); });

}  // namespace
}  // namespace gait::testing
