// A walk played on a model's body: what comes out, at which speed, in which loop.
#include "gait/play/clips/clip_player.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "gait/corpus/demo_motion.h"
#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/play/stream_reconstructor.h"
#include "play/few_walks.h"
#include "play/forbidden_memory.h"

namespace gait {
namespace {

using testing::few_walks;
using testing::few_walks_model;
using testing::ForbiddenMemory;
using testing::plan_of;

std::shared_ptr<const BodyMotion> motion_of(const CorpusWalk& walk, const Model& model) {
  return std::make_shared<BodyMotion>(
      motion_on_body(walk.clip, model, labels_from_contacts(walk.contacts, walk.clip.frame_rate)));
}

ClipPlayer player_of(const std::string& style, double rate = 30) {
  ClipPlayer player(few_walks_model());
  player.set_motion(motion_of(make_walk(plan_of(style, 9), rate), *few_walks_model()));
  return player;
}

// A model that is given the hips: learnt quickly, from the same walks.
std::shared_ptr<const Model> model_with_measured_hips() {
  static const std::shared_ptr<const Model> model = [] {
    const Skeleton skeleton = few_walks().front().clip.skeleton;
    const Body& body = *few_walks_model()->body;
    WalkOptions options;
    options.input_joints.push_back(skeleton.joints[body_roles(body).hips].name);
    for (const int joint : body.input_joints)
      options.input_joints.push_back(skeleton.joints[joint].name);
    for (const int joint : body.output_joints)
      if (body.roles[joint] != Role::hips)
        options.output_joints.push_back(skeleton.joints[joint].name);
    const WalkSequences sequences = walk_sequences(few_walks(), options);
    LearningOptions learning;
    learning.states = 3;
    auto learnt = std::make_shared<Model>(learn(walking_task(sequences), learning).model);
    learnt->body = sequences.body;
    return learnt;
  }();
  return model;
}

// What the player of a model is fed with when `gait reconstruct` plays this clip to it.
std::vector<std::vector<float>> fed_by_reconstruct(const Clip& clip,
                                                   const std::shared_ptr<const Model>& model) {
  const Body& body = *model->body;
  const BodyPoses poses =
      body_poses(clip, body, match_joints(body, clip.skeleton, clip.name), body.heading_window);
  std::vector<Eigen::Quaternionf> references;
  for (const auto& reference : body.references) references.push_back(reference.cast<float>());
  StreamReconstructor reconstructor(model);
  std::vector<std::vector<float>> fed;
  for (int frame = 0; frame < poses.frames(); ++frame) {
    std::vector<Eigen::Quaternionf> inputs;
    for (const int joint : body.input_joints) {
      const bool hips = body.roles[joint] == Role::hips;
      inputs.push_back(
          Eigen::Quaterniond(hips ? about_vertical(poses.heading[frame]) * poses.pose(frame)[joint]
                                  : poses.pose(frame)[joint])
              .cast<float>());
    }
    reconstructor.push(frame / clip.frame_rate, inputs);
    while (reconstructor.next()) {
      fed.emplace_back(3 * body.input_joints.size());
      pose_vector<float>(reconstructor.frame().pose, references, body.input_joints, fed.back());
    }
  }
  return fed;
}

TEST(ClipPlayer, gives_a_model_what_reconstruct_gives_it) {
  for (const auto& model : {few_walks_model(), model_with_measured_hips()})
    for (const int rate : {30, 60, 120, 25}) {
      const CorpusWalk walk = make_walk(plan_of("drunk", 9), rate);
      const auto fed = fed_by_reconstruct(walk.clip, model);
      ClipPlayer player(model);
      ASSERT_TRUE(player.set_motion(motion_of(walk, *model)));
      const bool hips = model != few_walks_model();
      std::size_t frame = 0;
      for (; player.advance(); ++frame) {
        ASSERT_LT(frame, fed.size());
        for (std::size_t i = 0; i < fed[frame].size(); ++i)
          // Where frames lie between the model's, measured hips turn by an interpolated heading.
          ASSERT_NEAR(player.frame().inputs[i], fed[frame][i], hips && rate == 25 ? 2e-3 : 2e-6)
              << rate << " fps, frame " << frame << ", value " << i;
      }
      EXPECT_EQ(frame, fed.size()) << rate;
    }
}

TEST(ClipPlayer, tells_the_whole_truth_of_a_frame) {
  const auto model = few_walks_model();
  const CorpusWalk walk = make_walk(plan_of("sad", 9));
  const auto motion = motion_of(walk, *model);
  ClipPlayer player(model);
  player.set_motion(motion);
  const Clip again = clip_of(*motion, *model->body);
  const int hips = body_roles(*model->body).hips;
  for (int frame = 0; player.advance(); ++frame) {
    EXPECT_NEAR(player.frame().time, frame / 30.0, 1e-9);
    EXPECT_LT((player.frame().hips.cast<double>() - walk.clip.translation(frame)[hips]).norm(),
              1e-5);
    for (int joint = 0; joint < again.skeleton.size(); ++joint) {
      const Eigen::Quaterniond truth = walk.clip.pose(frame)[joint];
      // As the clip of the motion has it, and as values with root do.
      EXPECT_LT(angle_between(again.pose(frame)[joint], truth), 1e-5);
      Eigen::Quaternionf told =
          rotation_from<float>(player.frame().pose.subspan(3 * joint).first<3>(),
                               model->body->references[joint].cast<float>());
      if (joint == hips) told = about_vertical(player.frame().heading) * told;
      EXPECT_LT(angle_between(told.cast<double>(), truth), 1e-5);
    }
  }
}

TEST(ClipPlayer, touches_and_steps_when_the_label_file_says) {
  const CorpusWalk walk = make_walk(plan_of("proud", 9));
  ClipPlayer player = player_of("proud");
  std::vector<Contact> played;
  std::string label;
  for (int frame = 0; player.advance(); ++frame) {
    if (player.frame().right) played.push_back({frame, Foot::right});
    if (player.frame().left) played.push_back({frame, Foot::left});
    if (!played.empty() && frame < walk.contacts.back().frame)
      EXPECT_EQ(player.label(), foot_name(played.back().foot)) << frame;
    else
      EXPECT_EQ(player.label(), "") << frame;
  }
  EXPECT_EQ(played, walk.contacts);
}

TEST(ClipPlayer, walks_on_where_a_loop_goes_back) {
  ClipPlayer player = player_of("in-a-hurry");
  player.set_loop(0.5, 2.8);
  float fastest = 0;
  player.advance();
  Eigen::Vector3f before = player.frame().hips;
  int rights = 0;
  for (int frame = 1; frame < 400; ++frame) {
    ASSERT_TRUE(player.advance());
    EXPECT_LT(player.frame().time, 2.8);
    rights += player.frame().right;
    Eigen::Vector3f moved = player.frame().hips - before;
    moved.y() = 0;
    fastest = std::max(fastest, moved.norm());
    before = player.frame().hips;
  }
  // 13 seconds at about 1.9 m/s, never a jump.
  EXPECT_LT(fastest * 30, 3);
  EXPECT_GT(before.z(), 20);
  EXPECT_GT(rights, 10);
  EXPECT_NEAR(player.frame().time, std::fmod(399 / 30.0 - 0.5, 2.3) + 0.5, 1e-6);
}

TEST(ClipPlayer, loops_the_whole_walk_with_equal_steps_where_it_is_whole_cycles) {
  const auto model = few_walks_model();
  ClipPlayer player(model);
  player.set_motion(std::make_shared<BodyMotion>(demo_motion("gait-demo:sad", *model)));
  player.set_loop(true);
  const int frames = player.motion()->frames();
  std::vector<Contact> played;
  std::vector<float> way;
  for (int frame = 0; frame < 3 * frames; ++frame) {
    ASSERT_TRUE(player.advance());
    if (player.frame().right) played.push_back({frame, Foot::right});
    if (player.frame().left) played.push_back({frame, Foot::left});
    way.push_back(player.frame().hips.z());
  }
  ASSERT_EQ(played.size(), 3u * 16);
  for (std::size_t i = 0; i < played.size(); ++i) {
    EXPECT_EQ(played[i].foot, i % 2 == 0 ? Foot::right : Foot::left);
    EXPECT_EQ(played[i].frame, static_cast<int>(i / 16) * frames + played[i % 16].frame);
  }
  // The step over the seam is as long as others.
  const float seam = way[frames] - way[frames - 1],
              usual = (way[frames - 1] - way[0]) / static_cast<float>(frames - 1);
  EXPECT_NEAR(seam, usual, 0.5 * usual);
}

TEST(ClipPlayer, plays_faster_slower_and_backwards) {
  for (const double speed : {0.25, 0.5, 1.7, 3.0}) {
    ClipPlayer player = player_of("sad");
    player.set_speed(speed);
    int frames = 0, contacts = 0;
    for (; player.advance(); ++frames) contacts += player.frame().right + player.frame().left;
    const int of_walk = player.motion()->frames();
    EXPECT_EQ(frames, static_cast<int>(std::floor((of_walk - 1) / speed + 1e-6)) + 1) << speed;
    EXPECT_GE(contacts, static_cast<int>(player.motion()->contacts.size()) - 1);
  }
  ClipPlayer forward = player_of("sad"), backward = player_of("sad");
  std::vector<std::vector<float>> poses;
  int touches = 0;
  while (forward.advance()) {
    poses.emplace_back(forward.frame().pose.begin(), forward.frame().pose.end());
    touches += forward.frame().right + forward.frame().left;
  }
  backward.set_speed(-1);
  backward.go_to(1e9);
  while (backward.advance()) {
    ASSERT_FALSE(poses.empty());
    EXPECT_TRUE(
        std::equal(poses.back().begin(), poses.back().end(), backward.frame().pose.begin()));
    touches -= backward.frame().right + backward.frame().left;
    poses.pop_back();
  }
  EXPECT_TRUE(poses.empty());
  EXPECT_EQ(touches, 0);
}

TEST(ClipPlayer, halfway_between_two_frames_is_the_same_as_a_walk_of_twice_the_rate) {
  ClipPlayer slow = player_of("drunk", 30), fine = player_of("drunk", 60);
  slow.set_speed(0.5);
  fine.set_speed(0.5);
  double furthest = 0, sum = 0;
  int values = 0;
  while (slow.advance() && fine.advance())
    for (std::size_t i = 0; i < slow.frame().pose.size(); ++i) {
      const double error = std::abs(slow.frame().pose[i] - fine.frame().pose[i]);
      furthest = std::max(furthest, error);
      sum += error;
      ++values;
    }
  EXPECT_GT(furthest, 0);
  // Feet are stopped by the ground between two frames; all else bends little.
  EXPECT_LT(furthest, 0.15);
  EXPECT_LT(sum / values, 1e-3);
}

TEST(ClipPlayer, goes_to_a_moment_and_keeps_its_loop_within_the_walk) {
  ClipPlayer player = player_of("proud");
  player.go_to(1.5);
  ASSERT_TRUE(player.advance());
  EXPECT_EQ(player.frame().time, 1.5);
  const double length = player.motion()->length();
  player.go_to(1e9);
  ASSERT_TRUE(player.advance());
  EXPECT_NEAR(player.frame().time, length - 1 / 30.0, 1e-9);
  EXPECT_FALSE(player.advance());
  EXPECT_FALSE(player.advance());
  // From behind a loop into it, at once and without a jump.
  const Eigen::Vector3f before = player.frame().hips;
  player.set_loop(1, 2);
  ASSERT_TRUE(player.advance());
  EXPECT_NEAR(player.frame().time, 1, 1e-9);
  EXPECT_LT((player.frame().hips - before).head<1>().norm(), 0.1);
  // A loop of nothing is a loop of everything.
  player.set_loop(2, 2.001);
  player.go_to(length - 1 / 30.0);
  ASSERT_TRUE(player.advance());
  ASSERT_TRUE(player.advance());
  EXPECT_NEAR(player.frame().time, 0, 1e-9);
}

TEST(ClipPlayer, says_no_to_walks_of_other_bodies_and_plays_nothing_without_one) {
  ClipPlayer player(few_walks_model());
  EXPECT_FALSE(player.advance());
  auto other = std::make_shared<BodyMotion>();
  other->joints = 3;
  other->rotations.resize(3);
  other->hips.resize(1);
  other->heading.resize(1);
  EXPECT_FALSE(player.set_motion(other));
  EXPECT_FALSE(player.advance());
  auto bodiless = std::make_shared<Model>(*few_walks_model());
  bodiless->body.reset();
  EXPECT_THROW(ClipPlayer{bodiless}, Error);
}

TEST(ClipPlayer, takes_no_memory_while_it_plays) {
  if (!ForbiddenMemory::works()) GTEST_SKIP() << "a sanitizer has malloc";
  ClipPlayer player = player_of("drunk", 120);
  player.set_speed(1.3);
  long taken = 0;
  {
    const ForbiddenMemory forbidden;
    player.set_loop(0.3, 1.9);
    for (int frame = 0; frame < 300; ++frame) player.advance();
    player.go_to(0.7);
    player.set_speed(-2);
    for (int frame = 0; frame < 300; ++frame) player.advance();
    taken = forbidden.allocations() + forbidden.releases();
  }
  EXPECT_EQ(taken, 0);
}

class FolderOfWalks : public ::testing::Test {
 protected:
  FolderOfWalks() { std::filesystem::remove_all(folder_); }
  ~FolderOfWalks() override { std::filesystem::remove_all(folder_); }
  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / "gait_clip_player_test";
};

TEST_F(FolderOfWalks, are_read_in_centimetres_with_their_labels_or_contacts_of_their_own) {
  const auto model = few_walks_model();
  const CorpusWalk walk = make_walk(plan_of("sad", 9));
  const auto path = write_corpus(folder_, {&walk, 1}, 0.01).front();
  const BodyMotion read = motion_named(path.string(), *model), made = *motion_of(walk, *model);
  ASSERT_EQ(read.frames(), made.frames());
  EXPECT_EQ(read.contacts, made.contacts);
  EXPECT_EQ(read.labels.size(), made.labels.size());
  for (std::size_t i = 0; i < read.rotations.size(); ++i)
    EXPECT_LT(angle_between(read.rotations[i], made.rotations[i]), 1e-3);
  for (int frame = 0; frame < read.frames(); ++frame)
    EXPECT_LT((read.hips[frame] - made.hips[frame]).norm(), 1e-4);

  std::filesystem::remove(std::filesystem::path(path).replace_extension(".txt"));
  const BodyMotion unlabelled = read_motion(path, *model);
  ASSERT_EQ(unlabelled.contacts.size(), made.contacts.size());
  for (std::size_t i = 0; i < made.contacts.size(); ++i) {
    EXPECT_EQ(unlabelled.contacts[i].foot, made.contacts[i].foot);
    EXPECT_NEAR(unlabelled.contacts[i].frame, made.contacts[i].frame, 3);
  }
}

TEST_F(FolderOfWalks, that_cannot_be_played_are_refused_with_the_reason) {
  const auto model = few_walks_model();
  const auto reason = [&](const std::string& name) {
    try {
      motion_named(name, *model);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(reason((folder_ / "none.bvh").string()).find("none.bvh"), std::string::npos);
  EXPECT_NE(reason("gait-demo:furious").find("furious"), std::string::npos);
  EXPECT_NE(reason("gait-demo:sad:0").find("from 1"), std::string::npos);

  const CorpusWalk walk = make_walk(plan_of("sad", 9));
  const auto path = write_corpus(folder_, {&walk, 1}, 0.01).front();
  const auto labels = std::filesystem::path(path).replace_extension(".txt");
  write_labels({{0, 0.5, "right"}, {0.4, 0.9, "left"}}, LabelForm::audacity, labels);
  EXPECT_NE(reason(path.string()).find(labels.string()), std::string::npos);
  write_labels({{0, 500, "right"}}, LabelForm::audacity, labels);
  EXPECT_NE(reason(path.string()).find("500"), std::string::npos);

  Clip other = walk.clip;
  other.skeleton.joints[3].name = "Rucksack";
  write_bvh(bvh_from_clip(other), path);
  std::filesystem::remove(labels);
  EXPECT_NE(reason(path.string()).find("missing"), std::string::npos);
}

}  // namespace
}  // namespace gait
