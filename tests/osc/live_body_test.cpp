// A live performer on a model's body: whatever his rig, after calibration the walk is the walk.
#include "gait/osc/live_body.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "gait/corpus/corpus.h"
#include "gait/corpus/demo_model.h"
#include "gait/model/body_pose.h"
#include "gait/motion/kinematics.h"
#include "gait/osc/humanoid_sender.h"
#include "gait/osc/rig_sender.h"
#include "gait/play/stream_reconstructor.h"
#include "osc/captured.h"
#include "osc/strange_sender.h"

namespace gait::testing {
namespace {

constexpr double degree = std::numbers::pi / 180;

std::shared_ptr<const Model> demo() {
  static const auto model = std::make_shared<const Model>(make_demo_model());
  return model;
}

Clip walk(const std::string& style) {
  return make_walk({.style = corpus_style(style), .cycles = 6, .seed = 99, .take = 3}).clip;
}

struct Decided {
  std::vector<int> label;
  std::vector<std::vector<float>> inputs;
};

Decided decide(const std::vector<std::vector<float>>& inputs) {
  Decided decided;
  decided.inputs = inputs;
  StreamReconstructor reconstructor(demo());
  for (const auto& values : inputs) {
    if (reconstructor.advance(values))
      decided.label.push_back(reconstructor.frame().decision.label);
  }
  return decided;
}

Decided from_file(const Clip& clip) {
  const Body& body = *demo()->body;
  const BodyPoses poses = body_poses(clip, body, match_joints(body, clip.skeleton, clip.name), 1.1);
  std::vector<Eigen::Quaterniond> references = body.references;
  std::vector<std::vector<float>> inputs;
  for (int frame = 0; frame < poses.frames(); ++frame) {
    std::vector<double> values(static_cast<std::size_t>(demo()->input.values));
    pose_vector<double>(poses.pose(frame), references, body.input_joints, values);
    inputs.emplace_back(values.begin(), values.end());
  }
  return decide(inputs);
}

// The same streamed by a strange rig that stands in `stand` first.
Decided from_stream(const Clip& clip, CalibrationPose stand, double wobble = 0) {
  const HumanoidBody body = osc::humanoid_of(*demo()->body);
  StrangeSender sender(7);
  Listened listened;
  osc::LiveBody live(demo());
  HumanoidPose standing = standing_pose(body, stand);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (Eigen::Quaterniond& turn : standing.turns)
    turn = exponential_map<double>(
               wobble * Eigen::Vector3d(normal(random), normal(random), normal(random))) *
           turn;
  double time = 0;
  for (int i = 0; i < 10; ++i)
    listened.hear_all(sender.packets(standing).packets(), time += 1 / 30.0);
  for (const auto& frame : listened.frames) {
    if (&frame == &listened.frames[5]) live.calibrate(stand);
    EXPECT_TRUE(live.take(frame));
  }
  EXPECT_TRUE(live.calibrated());
  std::vector<std::vector<float>> inputs;
  for (const HumanoidPose& pose : humanoid_poses(clip, body)) {
    listened.frames.clear();
    listened.hear_all(sender.packets(pose).packets(), time += 1 / 30.0);
    EXPECT_EQ(listened.frames.size(), 1u);
    EXPECT_TRUE(live.take(listened.frames.at(0)));
    inputs.emplace_back(live.frame().inputs.begin(), live.frame().inputs.end());
  }
  return decide(inputs);
}

double agreement(const Decided& a, const Decided& b) {
  EXPECT_EQ(a.label.size(), b.label.size());
  int same = 0;
  for (std::size_t i = 0; i < a.label.size(); ++i) same += a.label[i] == b.label[i] ? 1 : 0;
  return static_cast<double>(same) / static_cast<double>(a.label.size());
}

TEST(LiveBody, a_strange_rig_decides_as_the_file_does_after_calibration) {
  for (const std::string style : {"neutral", "sad", "drunk", "cool"})
    for (const CalibrationPose stand : {CalibrationPose::t, CalibrationPose::i}) {
      const Clip clip = walk(style);
      const Decided file = from_file(clip), stream = from_stream(clip, stand);
      EXPECT_GE(agreement(file, stream), 0.98) << style;
      for (std::size_t frame = 0; frame < file.inputs.size(); ++frame)
        for (std::size_t i = 0; i < file.inputs[frame].size(); ++i)
          ASSERT_NEAR(file.inputs[frame][i], stream.inputs[frame][i], 1e-4) << frame << " " << i;
    }
}

// Nobody stands in a T-pose to the degree.
TEST(LiveBody, a_performer_who_does_not_stand_quite_so_is_still_understood) {
  for (const double off : {0.3, 1.0, 3.0}) {
    double sum = 0;
    for (const std::string style : {"neutral", "sad", "drunk", "cool"})
      sum += agreement(from_file(walk(style)),
                       from_stream(walk(style), CalibrationPose::t, off * degree / std::sqrt(3.0)));
    RecordProperty("agreement_" + std::to_string(static_cast<int>(10 * off)),
                   std::to_string(sum / 4));
    std::printf("%.1f degrees off: %.1f %% of decisions\n", off, 25 * sum);
    EXPECT_GE(sum / 4, off < 2 ? 0.98 : 0.96);
  }
}

TEST(LiveBody, bones_that_stop_are_held_then_missing_and_taken_in_again) {
  const HumanoidBody body = osc::humanoid_of(*demo()->body);
  osc::LiveBody live(demo());
  live.set_hold(0.5);
  Listened listened;
  StrangeSender sender(2);
  std::vector<HumanoidPose> poses = humanoid_poses(walk("neutral"), body);
  int input = -1;
  for (std::size_t i = 0; i < demo()->inputs.size(); ++i)
    if (demo()->inputs[i].name == "LeftForeArm") input = static_cast<int>(i);
  ASSERT_GE(input, 0);
  std::vector<bool> there(demo()->inputs.size(), true);
  std::vector<std::string> news;
  std::vector<float> held;
  for (int frame = 0; frame < 90; ++frame) {
    HumanoidPose pose = poses[static_cast<std::size_t>(frame)];
    const bool lost = frame >= 30 && frame < 60;
    if (lost) pose.turned.reset(index_of(Bone::left_lower_arm));
    listened.frames.clear();
    listened.hear_all(sender.packets(pose).packets(), frame / 30.0);
    ASSERT_TRUE(live.take(listened.frames.at(0)));
    for (std::size_t i = 0; i < demo()->inputs.size(); ++i) {
      if (live.there(static_cast<int>(i)) == there[i]) continue;
      there[i] = !there[i];
      news.push_back(demo()->inputs[i].name + (there[i] ? " back " : " gone ") +
                     std::to_string(frame));
    }
  }
  EXPECT_EQ(news, (std::vector<std::string>{"LeftForeArm gone 45", "LeftForeArm back 60"}));
}

TEST(LiveBody, a_camera_that_sees_places_gives_the_same_directions) {
  const Clip clip = walk("neutral");
  const HumanoidBody body = osc::humanoid_of(*demo()->body);
  const WorldPoses world = world_poses(clip);
  const auto joints = static_cast<std::size_t>(clip.skeleton.size());
  const std::vector<std::pair<std::string, Bone>> seen{{"head", Bone::head},
                                                       {"neck", Bone::neck},
                                                       {"l_shoulder", Bone::left_upper_arm},
                                                       {"l_elbow", Bone::left_lower_arm},
                                                       {"l_hand", Bone::left_hand},
                                                       {"r_shoulder", Bone::right_upper_arm},
                                                       {"r_elbow", Bone::right_lower_arm},
                                                       {"r_hand", Bone::right_hand},
                                                       {"l_hip", Bone::left_upper_leg},
                                                       {"l_knee", Bone::left_lower_leg},
                                                       {"l_ankle", Bone::left_foot},
                                                       {"r_hip", Bone::right_upper_leg},
                                                       {"r_knee", Bone::right_lower_leg},
                                                       {"r_ankle", Bone::right_foot}};
  Listened listened;
  osc::SenderPose pose;
  for (int frame = 0; frame < clip.frames(); frame += 7) {
    HumanoidPose truth;
    const std::size_t at = joints * static_cast<std::size_t>(frame);
    body.read({world.rotations.data() + at, joints}, {world.positions.data() + at, joints}, truth);
    listened.frames.clear();
    for (const auto& [name, bone] : seen) {
      // Towards the camera, Y down: a left-handed or turned frame, as cameras have it.
      const Eigen::Vector3d p = 100 * truth.places[index_of(bone)];
      listened.say("/joint", "siifffff", {name},
                   {0, 4, static_cast<float>(p.x()), static_cast<float>(-p.y()),
                    static_cast<float>(900 - p.z()), 1, 0},
                   frame);
    }
    listened.gatherer.end_old(frame + 1, listened);
    ASSERT_EQ(listened.frames.size(), 1u);
    ASSERT_TRUE(pose.take(listened.frames[0]));
    const Eigen::Quaterniond away = about_vertical(std::numbers::pi);  // he faces the camera
    for (const auto& [bone, end] : {std::pair(Bone::left_upper_arm, Bone::left_lower_arm),
                                    std::pair(Bone::right_lower_arm, Bone::right_hand),
                                    std::pair(Bone::left_lower_leg, Bone::left_foot)}) {
      const Eigen::Vector3d was = truth.places[index_of(end)] - truth.places[index_of(bone)];
      ASSERT_TRUE(pose.world().turned[index_of(bone)]);
      Eigen::Vector3d rest(0, -1, 0);
      if (bone == Bone::left_upper_arm) rest = {1, 0, 0};
      if (bone == Bone::right_lower_arm) rest = {-1, 0, 0};
      const Eigen::Vector3d is = pose.world().turns[index_of(bone)] * rest;
      EXPECT_LT(std::acos(std::min(1.0, (away * was).normalized().dot(is))), 1e-3);
    }
  }
}

// The project's own form: the rig by its own names, as `gait stream --form gait` sends it.
TEST(LiveBody, a_rig_told_by_its_own_names_is_the_walk_itself) {
  const Clip clip = walk("drunk");
  const Decided file = from_file(clip);
  osc::RigSender sender(clip.skeleton);
  Listened listened;
  listened.hear_all(sender.rig(), 0);
  osc::LiveBody live(demo());
  const int hips = body_roles(*demo()->body).hips;
  for (int frame = 0; frame < clip.frames(); ++frame) {
    listened.frames.clear();
    sender.pack(clip.pose(frame), clip.translation(frame), frame);
    listened.hear_all(sender.packets(), frame / 30.0);
    ASSERT_EQ(listened.frames.size(), 1u);
    ASSERT_TRUE(live.take(listened.frames[0]));
    EXPECT_TRUE(live.frame().posed);
    EXPECT_LT(
        (live.frame().hips.cast<double>() - clip.translation(frame)[static_cast<std::size_t>(hips)])
            .norm(),
        1e-4);
    const auto& inputs = file.inputs[static_cast<std::size_t>(frame)];
    for (std::size_t i = 0; i < inputs.size(); ++i)
      ASSERT_NEAR(live.frame().inputs[i], inputs[i], 1e-4) << frame << " " << i;
    for (std::size_t i = 0; i < demo()->inputs.size(); ++i)
      EXPECT_TRUE(live.there(static_cast<int>(i)));
  }
}

TEST(LiveBody, values_of_another_model_are_not_taken) {
  osc::LiveBody live(demo());
  Listened listened;
  listened.say("/gait/frame", "fff", {}, {1, 2, 3});
  ASSERT_EQ(listened.frames.size(), 1u);
  EXPECT_FALSE(live.take(listened.frames[0]));
  const int values = demo()->input.values;
  std::vector<float> numbers;
  for (int i = 0; i < values; ++i) numbers.push_back(0.01F * static_cast<float>(i));
  listened.say("/gait/frame", std::string(static_cast<std::size_t>(values), 'f'), {}, numbers);
  ASSERT_TRUE(live.take(listened.frames.at(1)));
  EXPECT_EQ(std::vector<float>(live.frame().inputs.begin(), live.frame().inputs.end()), numbers);
  EXPECT_FALSE(live.frame().posed);
}

}  // namespace
}  // namespace gait::testing
