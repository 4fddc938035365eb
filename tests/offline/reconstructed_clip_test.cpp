#include "gait/offline/reconstructed_clip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gait/error.h"
#include "gait/motion/rotation.h"
#include "play/few_walks.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::plan_of;

BodyPoses poses_of(const Clip& clip, const Body& body) {
  return body_poses(clip, body, match_joints(body, clip.skeleton, clip.name), body.heading_window);
}

TEST(ReconstructedClip, has_frame_for_frame_the_input_joints_as_they_were) {
  const auto model = few_walks_model();
  for (const int rate : {30, 60, 120, 25}) {
    const CorpusWalk walk = make_walk(plan_of("sad", 9), rate);
    const ReconstructedClip made =
        reconstruct_clip(model, poses_of(walk.clip, *model->body), rate, "made", {});
    ASSERT_EQ(made.clip.frames(), walk.clip.frames()) << rate;
    EXPECT_EQ(made.clip.frame_rate, rate);
    EXPECT_EQ(static_cast<int>(made.decisions.size()), walk.clip.frames());
    EXPECT_EQ(made.style_posteriors.cols(), walk.clip.frames());
    for (int frame = 0; frame < made.clip.frames(); ++frame)
      for (const int joint : model->body->input_joints)
        // Between two frames of the model's clock they are interpolated.
        EXPECT_LT(angle_between(made.clip.pose(frame)[joint], walk.clip.pose(frame)[joint]),
                  rate == 30 ? 1e-3 : 0.1)
            << rate << " frame " << frame;
  }
}

TEST(ReconstructedClip, is_better_than_the_mean_pose_and_travels_as_far) {
  const auto model = few_walks_model();
  const CorpusWalk walk = make_walk(plan_of("proud", 9));
  const Body& body = *model->body;
  const BodyPoses truth = poses_of(walk.clip, body);
  const ReconstructedClip made = reconstruct_clip(model, truth, 30, "made", {});
  double error = 0, mean_pose_error = 0;
  const int begin = walk.contacts.front().frame, end = walk.contacts.back().frame;
  for (int frame = begin; frame < end; ++frame)
    for (const int joint : body.output_joints) {
      if (body.roles[joint] == Role::hips) continue;
      error += angle_between(made.clip.pose(frame)[joint], truth.pose(frame)[joint]);
      mean_pose_error += angle_between(body.references[joint], truth.pose(frame)[joint]);
    }
  EXPECT_LT(error, 0.5 * mean_pose_error);
  const auto path = [&](const Clip& clip) {
    const int hips = body_roles(body).hips;
    Eigen::Vector3d way = clip.translation(end)[hips] - clip.translation(begin)[hips];
    way.y() = 0;
    return way.norm();
  };
  EXPECT_NEAR(path(made.clip) / path(walk.clip), 1, 0.1);
}

TEST(ReconstructedClip, looks_at_input_joints_alone) {
  const auto model = few_walks_model();
  const CorpusWalk walk = make_walk(plan_of("drunk", 9));
  const BodyPoses poses = poses_of(walk.clip, *model->body);
  BodyPoses noisy = poses;
  for (int frame = 0; frame < noisy.frames(); ++frame)
    for (const int joint : model->body->output_joints)
      noisy.rotations[static_cast<std::size_t>(frame) * noisy.joints + joint] =
          Eigen::Quaterniond(Eigen::Vector4d::Random()).normalized();
  const ReconstructedClip a = reconstruct_clip(model, poses, 30, "a", {});
  const ReconstructedClip b = reconstruct_clip(model, noisy, 30, "b", {});
  for (std::size_t i = 0; i < a.clip.rotations.size(); ++i)
    ASSERT_EQ(a.clip.rotations[i].coeffs(), b.clip.rotations[i].coeffs());
  EXPECT_EQ(a.clip.translations, b.clip.translations);
}

TEST(ReconstructedClip, with_delays_is_as_long_and_in_time) {
  const auto model = few_walks_model();
  const CorpusWalk walk = make_walk(plan_of("sad", 9));
  const BodyPoses poses = poses_of(walk.clip, *model->body);
  PlaySettings settings;
  settings.decoder = DecoderKind::lag;
  settings.lag = 0.2;
  settings.future = 3;
  settings.current = 2;
  const ReconstructedClip made = reconstruct_clip(model, poses, 30, "made", settings);
  EXPECT_EQ(made.delay_frames, 6 + 3 + 1);
  ASSERT_EQ(made.clip.frames(), walk.clip.frames());
  for (int frame = 0; frame < made.clip.frames(); ++frame)
    for (const int joint : model->body->input_joints)
      EXPECT_LT(angle_between(made.clip.pose(frame)[joint], walk.clip.pose(frame)[joint]), 1e-3);
}

TEST(ReconstructedClip, of_no_frames_is_empty_and_of_no_body_an_error) {
  const auto model = few_walks_model();
  CorpusWalk walk = make_walk(plan_of("sad", 9));
  walk.clip.resize(0);
  const ReconstructedClip none =
      reconstruct_clip(model, poses_of(walk.clip, *model->body), 30, "none", {});
  EXPECT_EQ(none.clip.frames(), 0);
  auto bodiless = std::make_shared<Model>(*model);
  bodiless->body.reset();
  EXPECT_THROW(reconstruct_clip(bodiless, {}, 30, "none", {}), Error);
}

}  // namespace
}  // namespace gait
