// The forms of suits and cameras beside OSC: worked packets, made from the facts by hand, and six
// poses packed and read again.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <numbers>

#include "gait/motion/rotation.h"
#include "gait/osc/forms.h"
#include "gait/osc/humanoid_sender.h"
#include "gait/osc/mediapipe_landmarks.h"
#include "gait/osc/sender_pose.h"
#include "osc/bad_packets.h"
#include "osc/captured.h"
#include "osc/six_poses.h"

namespace gait::testing {
namespace {

using osc::MocapForm;

constexpr double degree = std::numbers::pi / 180;

Packet bytes_of_hex(std::string_view hex) {
  Packet bytes;
  int half = -1;
  for (const char c : hex) {
    if (c == ' ' || c == '\n') continue;
    const int digit = c <= '9' ? c - '0' : c - 'a' + 10;
    if (half < 0) {
      half = digit;
      continue;
    }
    bytes.push_back(static_cast<std::byte>(16 * half + digit));
    half = -1;
  }
  return bytes;
}

// Frame 7 of mocopi: the root alone, 0.9375 m high, 1.7e9 s since 1970.
const char* const mocopi_frame =
    "23000000 68656164 12000000 66747970 736f6e79206d6f74696f6e20666f726d6174 01000000 7672736e 01"
    "1a000000 736e6466 08000000 69706164 0000000000000000 02000000 72637670 3f30"
    "66000000 6672616d 04000000 666e756d 07000000 04000000 74696d65 00000000 08000000 7574746d "
    "00000040fc54d941 36000000 62747273 2e000000 62746474 02000000 626e6964 0000 1c000000 7472616e "
    "00000000 00000000 00000000 0000803f 00000000 0000703f 00000000";

TEST(Suits, a_worked_packet_of_mocopi) {
  Listened listened;
  Packet packet = bytes_of_hex(mocopi_frame);
  listened.hear(packet, 1);
  ASSERT_EQ(listened.frames.size(), 1u);
  const auto& frame = listened.frames[0];
  EXPECT_EQ(frame.form, MocapForm::mocopi);
  EXPECT_FLOAT_EQ(frame.places[0][1], 0.9375F);
  EXPECT_DOUBLE_EQ(frame.sent, 1.7e9);
  listened.hear(packet, 1.02);  // the same frame again: overtaken
  EXPECT_EQ(listened.frames.size(), 1u);
  EXPECT_EQ(listened.faulty, 0);
  // A length that lies, a rotation that is none, another format.
  packet[0] = std::byte{0xFF};
  listened.hear(packet, 2);
  packet = bytes_of_hex(mocopi_frame);
  packet[packet.size() - 16] = packet[packet.size() - 13] = std::byte{0xFF};
  listened.hear(packet, 2);
  packet = bytes_of_hex(mocopi_frame);
  packet[16] = std::byte{'x'};
  listened.hear(packet, 2);
  EXPECT_EQ(listened.faulty, 3);
}

// Sample 1000 at 16.667 s: a pelvis at (0, 0, 0.9375), the other 22 segments 1 m further along Z.
Packet mvn_sample() {
  Packet packet = bytes_of_hex(
      "4d5854503032 000003e8 80 17 0000411b 00 17 00 00 0000 02e0"
      "00000001 00000000 00000000 3f700000 3f800000 00000000 00000000 00000000");
  for (int segment = 2; segment <= 23; ++segment) {
    Packet item =
        bytes_of_hex("00000000 00000000 00000000 3ff80000 3f800000 00000000 00000000 00000000");
    item[3] = static_cast<std::byte>(segment);
    packet.insert(packet.end(), item.begin(), item.end());
  }
  return packet;
}

TEST(Suits, a_worked_packet_of_mvn) {
  Listened listened;
  const Packet packet = mvn_sample();
  ASSERT_EQ(packet.size(), 760u);
  listened.hear(packet, 1);
  ASSERT_EQ(listened.frames.size(), 1u);
  EXPECT_FLOAT_EQ(listened.frames[0].places[0][1], 0.9375F);  // up
  EXPECT_EQ(listened.frames[0].rotated.count(), 22u);
  EXPECT_DOUBLE_EQ(listened.frames[0].sent, 16.667);
  EXPECT_FLOAT_EQ(listened.frames[0].places[index_of(Bone::head)][1], 1.9375F);
  // The left hand's segment has a place along Y, which is to the left.
  Packet left = packet;
  left[9] = std::byte{0xE9};
  const Packet one = bytes_of_hex("3f800000");
  std::copy(one.begin(), one.end(), left.begin() + 24 + 32 * 14 + 8);
  listened.hear(left, 1.02);
  EXPECT_FLOAT_EQ(listened.frames[1].places[index_of(Bone::left_hand)][0], 1);
  // What carries no pose is passed over; what is cut short is faulty.
  Packet named = bytes_of_hex("4d5854503132 000003e8 80 00 0000411b 00 17 00 00 0000 000a");
  listened.hear(named, 2);
  EXPECT_EQ(listened.faulty, 0);
  listened.hear(Packet(packet.begin(), packet.end() - 1), 2);
  EXPECT_EQ(listened.faulty, 1);
}

TEST(Suits, a_sample_of_mvn_in_two_datagrams_in_either_order_is_one_frame) {
  const Packet whole = mvn_sample();
  Packet first(whole.begin(), whole.begin() + 24 + 32 * 10),
      second(whole.begin(), whole.begin() + 24);
  second.insert(second.end(), whole.begin() + 24 + 32 * 10, whole.end());
  first[10] = std::byte{0}, first[11] = std::byte{10};
  second[10] = std::byte{0x81}, second[11] = std::byte{13};
  Listened listened;
  for (const bool swapped : {false, true}) {
    listened.hear(swapped ? second : first, 1);
    listened.hear(swapped ? first : second, 1.001);
    first[9] = second[9] = std::byte{0xE9};
  }
  EXPECT_EQ(listened.frames.size(), 2u);
  EXPECT_EQ(listened.faulty, 0);
}

// Segments in centimetres, in Euler angles, and in Unity's order: the same body.
TEST(Suits, other_types_and_units_of_mvn_are_the_same_body) {
  const auto put = [](Packet& packet, double x) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(x));
    for (int shift = 24; shift >= 0; shift -= 8)
      packet.push_back(static_cast<std::byte>(bits >> shift & 0xFF));
  };
  const HumanoidPose pose = six_poses()[2];
  osc::HumanoidSender sender(MocapForm::mvn, bones_of(pose));
  sender.pack(pose, 1, 1);
  const Packet quaternions(sender.packets().back().data);
  const auto header = [&](const char* type, std::uint8_t sample) {
    Packet packet(quaternions.begin(), quaternions.begin() + 24);
    std::memcpy(packet.data(), type, 6);
    packet[9] = static_cast<std::byte>(sample);
    return packet;
  };
  Listened two, one, five;
  two.hear(quaternions, 1);
  const auto& frame = two.frames.at(0);
  const auto turn_of = [&](int segment) {
    int bone = osc_bone_of_segment(segment);
    while (bone >= 0 && !frame.rotated[bone]) bone = bone_parent(bone);
    const auto& q = frame.rotations[bone];
    return Eigen::Quaterniond(double{q[3]}, double{q[0]}, double{q[1]}, double{q[2]});
  };
  const auto place_of = [&](int segment) {
    const auto& p = frame.places[osc_bone_of_segment(segment)];
    return Eigen::Vector3d(double{p[0]}, double{p[1]}, double{p[2]});
  };
  Packet euler = header("MXTP01", 1), unity = header("MXTP05", 1);
  for (int segment = 0; segment < 23; ++segment) {
    for (int i = 0; i < 4; ++i) euler.push_back(std::byte{0});
    const Eigen::Vector3d place = place_of(segment);
    for (int i = 0; i < 3; ++i) put(euler, 100 * place[i]);
    const Eigen::Matrix3d r = turn_of(segment).toRotationMatrix();
    put(euler, std::atan2(r(2, 1), r(2, 2)) / degree);
    put(euler, std::asin(std::clamp(-r(2, 0), -1.0, 1.0)) / degree);
    put(euler, std::atan2(r(1, 0), r(0, 0)) / degree);
  }
  constexpr int order[] = {0, 15, 16, 17, 18, 19, 20, 21, 22, 1, 2, 3,
                           4, 11, 12, 13, 14, 7,  8,  9,  10, 5, 6};
  constexpr int parents[] = {-1, 0,  1,  2, 3,  4,  5,  4, 7,  8,  9, 4,
                             11, 12, 13, 0, 15, 16, 17, 0, 19, 20, 21};
  for (const int segment : order) {
    for (int i = 0; i < 4; ++i) unity.push_back(std::byte{0});
    const int above = parents[segment];
    const Eigen::Vector3d place =
        above < 0
            ? place_of(segment)
            : Eigen::Vector3d(turn_of(above).conjugate() * (place_of(segment) - place_of(above)));
    for (const double x : {-place.x(), place.y(), place.z()}) put(unity, x);
    const Eigen::Quaterniond q =
        above < 0 ? turn_of(segment) : turn_of(above).conjugate() * turn_of(segment);
    for (const double x : {q.w(), q.x(), -q.y(), -q.z()}) put(unity, x);
  }
  one.hear(euler, 1);
  five.hear(unity, 1);
  ASSERT_EQ(one.frames.size(), 1u);
  ASSERT_EQ(five.frames.size(), 1u);
  for (const Listened* listened : {&one, &five}) {
    const auto& got = listened->frames[0];
    for (int bone = 0; bone < main_bones; ++bone) {
      const auto& a = frame.rotations[bone];
      const auto& b = got.rotations[bone];
      const double dot = std::abs(double{a[0]} * b[0] + double{a[1]} * b[1] + double{a[2]} * b[2] +
                                  double{a[3]} * b[3]);
      EXPECT_GT(dot, std::cos(0.05 * degree)) << bone_name(bone);
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(frame.places[bone][i], got.places[bone][i], 1e-3) << bone_name(bone);
    }
  }
}

TEST(Suits, a_worked_document_of_rokoko_in_each_version) {
  const std::string body =
      R"("hip":{"position":{"x":0.5,"y":1.0,"z":0},"rotation":{"x":0,"y":0,"z":0,"w":1}},)"
      R"("leftUpperArm":{"position":{"x":-0.2,"y":1.5,"z":0},)"
      R"("rotation":{"x":-0.5,"y":-0.5,"z":0.5,"w":-0.5}},)"
      R"("leftIndexProximal":{"position":{"x":-0.2,"y":1.5,"z":0},)"
      R"("rotation":{"x":-0.5,"y":-0.5,"z":0.5,"w":-0.5}})";
  const std::string third =
      R"({"version":"3.0","fps":30,"scene":{"timestamp":1.5,"actors":[{"name":"A","color":[255,0,0],)"
      R"("meta":{"hasGloves":false,"hasBody":true,"hasFace":false},"dimensions":{"totalHeight":1.8,)"
      R"("hipHeight":1.0},"body":{)" +
      body + R"(}}],"props":[]}})";
  const std::string second =
      R"({"version":3,"timestamp":1.5,"trackers":[],"props":[],"actors":[{"name":"A",)" + body +
      "}]}";
  for (const std::string& document : {third, second}) {
    Listened listened;
    listened.hear(std::as_bytes(std::span(document)), 1);
    ASSERT_EQ(listened.frames.size(), 1u);
    const auto& frame = listened.frames[0];
    EXPECT_EQ(frame.form, MocapForm::rokoko);
    EXPECT_DOUBLE_EQ(frame.sent, 1.5);
    EXPECT_FLOAT_EQ(frame.places[0][0], -0.5F);  // Unity's X is to the right
    EXPECT_NEAR(std::abs(frame.rotations[index_of(Bone::left_upper_arm)][3]), 1, 1e-6);
    EXPECT_EQ(frame.rotated[index_of(Bone::left_fingers) + 3],
              &document == &second || document == second);
    Listened cut;
    cut.hear(std::as_bytes(std::span(document)).first(document.size() - 9), 1);
    EXPECT_EQ(cut.faulty, 1);
  }
  Listened other;
  const std::string phone =
      R"({"device":{"uuid":"a1"},"sensordata":{"accel":{"x":0,"y":0,"z":1}}})";
  other.hear(std::as_bytes(std::span(phone)), 1);
  EXPECT_TRUE(other.frames.empty());
}

TEST(Suits, a_worked_message_of_mediapipe_and_of_a_tracker) {
  Listened listened;
  listened.hear(bytes_of_hex("2f706f73652f3135000000002c666666000000003e800000bf000000be000000"),
                1);
  EXPECT_EQ(listened.faulty + listened.unknown, 0);
  EXPECT_TRUE(listened.frames.empty());  // one landmark is no frame
  Listened tracker;
  tracker.hear(bytes_of_hex("2f747261636b696e672f747261636b6572732f312f706f736974696f6e000000"
                            "2c66666600000000000000003f8000003f000000"),
               1);
  ASSERT_EQ(tracker.events.size(), 1u);
  EXPECT_EQ(tracker.events[0].bone, index_of(Bone::hips));
  EXPECT_EQ(tracker.events[0].place, (std::array<float, 3>{-0.0F, 1, 0.5F}));
}

// Landmarks one by one, by number and by name, are the same body as all in one message.
TEST(Suits, landmarks_come_in_one_message_or_one_by_one) {
  osc::Landmarks landmarks;
  osc::landmarks_of(six_poses()[1], landmarks);
  Listened all, numbered;
  std::vector<float> numbers;
  for (int i = 0; i < osc::mediapipe_landmarks; ++i) {
    const Eigen::Vector3f p = landmarks.places[static_cast<std::size_t>(i)].cast<float>();
    numbers.insert(numbers.end(), {p.x(), p.y(), p.z()});
    numbered.say("/pose/" + std::to_string(i), "fff", {}, {p.x(), p.y(), p.z()});
  }
  all.say("/mediapipe/pose", std::string(99, 'f'), {}, numbers);
  ASSERT_EQ(all.frames.size(), 1u);
  ASSERT_EQ(numbered.frames.size(), 1u);
  EXPECT_EQ(all.frames[0].rotations, numbered.frames[0].rotations);
  EXPECT_GE(all.frames[0].rotated.count(), 14u);
  all.say("/mediapipe/pose", "i", {}, {0});  // none is seen
  EXPECT_EQ(all.faulty, 0);
  EXPECT_EQ(osc::landmark_named("left_foot_index"), 31);
  EXPECT_EQ(osc::landmark_named("rightWrist"), 16);
}

std::vector<float> numbers_of(const Listened& listened, const std::string& name) {
  std::vector<float> numbers;
  for (const auto& event : listened.events)
    if (event.kind == osc::MocapKind::plain && name == event.name.data())
      numbers.insert(numbers.end(), event.numbers.begin(), event.numbers.begin() + event.count);
  return numbers;
}

TEST(Suits, phones_and_wekinators_inputs_are_plain_streams) {
  Listened listened;
  listened.hear(bytes_of_hex("2f5a494753494d2f61312f7175617465726e696f6e0000002c66666666000000"
                             "0000000000000000000000003f800000"),
                1);
  listened.hear(bytes_of_hex("2f77656b2f696e70757473002c6666003f0000003f800000"), 1);
  const std::string json =
      R"({"device":{"uuid":"a1","os":"ios"},"timestamp":"2026-01-01T00:00:00.000",)"
      R"("sensordata":{"accel":{"x":0,"y":0,"z":0.1}}})";
  listened.hear(std::as_bytes(std::span(json)), 1);
  listened.say("/gyrosc/rrate", "fff", {}, {1, 2, 3});
  listened.say("/accxyz", "fff", {}, {4, 5, 6});
  listened.say("/gyroscope", "fff", {}, {7, 8, 9});
  EXPECT_EQ(numbers_of(listened, "quaternion"), (std::vector<float>{0, 0, 0, 1}));
  EXPECT_EQ(numbers_of(listened, "wek"), (std::vector<float>{0.5F, 1}));
  EXPECT_EQ(numbers_of(listened, "accel"), (std::vector<float>{0, 0, 0.1F}));
  EXPECT_EQ(numbers_of(listened, "rrate"), (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(numbers_of(listened, "accxyz"), (std::vector<float>{4, 5, 6}));
  EXPECT_EQ(numbers_of(listened, "gyroscope"), (std::vector<float>{7, 8, 9}));
  EXPECT_EQ(listened.faulty + listened.unknown, 0);
  EXPECT_TRUE(listened.frames.empty());
  std::vector<float> many(40);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<float>(i);
  Listened long_one;
  long_one.say("/wek/inputs", std::string(40, 'f'), {}, many);
  EXPECT_EQ(numbers_of(long_one, "wek"), many);
  long_one.say("/accxyz", "sff", {"x"}, {1, 2});
  EXPECT_EQ(long_one.faulty, 1);
}

class EachForm : public ::testing::TestWithParam<MocapForm> {};

TEST_P(EachForm, six_poses_come_out_as_they_went_in) {
  const MocapForm form = GetParam();
  const auto poses = six_poses();
  osc::HumanoidSender sender(form, bones_of(poses[0]));
  Listened listened;
  osc::SenderPose got;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    listened.frames.clear();
    for (int again = 0; again < 3; ++again) {
      const double time = static_cast<double>(3 * i) + again;
      sender.pack(poses[i], time, static_cast<int>(3 * i) + again);
      listened.hear_all(sender.packets(), time);
      listened.gatherer.end_old(time + 0.5, listened);
    }
    ASSERT_GE(listened.frames.size(), 3u);
    for (const auto& frame : listened.frames) ASSERT_TRUE(got.take(frame));
    expect_same_body(poses[i], got.world(), form, "pose " + std::to_string(i));
  }
  EXPECT_EQ(listened.faulty, 0);
  EXPECT_EQ(listened.unknown, 0);
}

INSTANTIATE_TEST_SUITE_P(Suits, EachForm,
                         ::testing::Values(MocapForm::vmc, MocapForm::natnet, MocapForm::neuron,
                                           MocapForm::mocopi, MocapForm::mvn, MocapForm::rokoko,
                                           MocapForm::mediapipe, MocapForm::trackers),
                         [](const auto& form) { return std::string(osc::form_name(form.param)); });

}  // namespace
}  // namespace gait::testing
