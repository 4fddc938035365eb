#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "gait/files/bvh.h"
#include "gait/judge/foot_slide.h"
#include "gait/motion/body_frame.h"
#include "gait/motion/contacts.h"
#include "gait/motion/resample.h"
#include "gait/motion/rotation.h"
#include "gait/play/body/root_motion.h"
#include "shared_data.h"

namespace gait {
namespace {

using Pose = std::vector<Eigen::Quaternionf>;
using Path = std::vector<Eigen::Vector3d>;

struct Walk {
  Clip clip;
  JointRoles roles;
  WalkTrack track;

  int frames() const { return clip.frames(); }
  Eigen::Vector3d hips(int frame) const { return at(frame, roles.hips); }
  Eigen::Vector3d at(int frame, int joint) const {
    return track.world.positions[static_cast<std::size_t>(frame) * clip.skeleton.size() + joint];
  }
  Pose pose(int frame) const {
    Pose pose;
    for (const auto& rotation : clip.pose(frame)) pose.push_back(rotation.cast<float>());
    pose[roles.hips] =
        track.world.rotations[static_cast<std::size_t>(frame) * clip.skeleton.size() + roles.hips]
            .cast<float>();
    return pose;
  }
};

Walk followed(Clip clip, const JointRoles& roles) {
  Walk walk{std::move(clip), roles, {}};
  walk.track = follow_walk(walk.clip, roles);
  return walk;
}

std::vector<Walk> captured(const char* folder, double rate = 0) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(testing::shared_data() / folder))
    if (entry.path().extension() == ".bvh") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Walk> walks;
  for (const auto& path : paths) {
    const Clip clip = clip_from_bvh(read_bvh(path));
    const JointRoles roles = find_roles(clip.skeleton);
    const Clip metres = in_metres_y_up(clip, guess_body_frame(clip, roles));
    walks.push_back(followed(rate > 0 ? resampled(metres, rate) : metres, roles));
  }
  return walks;
}

Path from_feet(const Walk& walk, bool backward = false) {
  RootMotion root(walk.clip.skeleton, walk.roles, walk.clip.frame_rate);
  Path path(walk.frames());
  for (int i = 0; i < walk.frames(); ++i) {
    const int frame = backward ? walk.frames() - 1 - i : i;
    path[frame] = root.advance(walk.pose(frame)).cast<double>();
  }
  return path;
}

Path captured_path(const Walk& walk) {
  Path path;
  for (int frame = 0; frame < walk.frames(); ++frame) path.push_back(walk.hips(frame));
  return path;
}

double horizontal(Eigen::Vector3d v) {
  v.y() = 0;
  return v.norm();
}

double length(const Path& path, int begin, int end) {
  double sum = 0;
  for (int frame = begin; frame < end; ++frame) sum += horizontal(path[frame + 1] - path[frame]);
  return sum;
}

// Length over all cycles against the captured one; 0 when the clip holds no cycle.
double share_of_captured_path(const Walk& walk, const Path& path) {
  double made = 0, was = 0;
  const Path truth = captured_path(walk);
  for (const Cycle& cycle : cycles_between(walk.track.contacts)) {
    made += length(path, cycle.begin, cycle.end);
    was += length(truth, cycle.begin, cycle.end);
  }
  return was > 0 ? made / was : 0;
}

double slide_of(const Walk& walk, const Path& path) {
  Clip moved = walk.clip;
  for (int frame = 0; frame < moved.frames(); ++frame) {
    // All of the body goes where the hips went: the roots are shifted, which roots do not turn.
    const Eigen::Vector3d shift = path[frame] - walk.hips(frame);
    for (int joint = 0; joint < moved.skeleton.size(); ++joint)
      if (moved.skeleton.joints[joint].parent < 0) moved.translation(frame)[joint] += shift;
  }
  return foot_slide(moved, walk.roles, walk.track.contacts).mean;
}

double largest_acceleration(const Path& path, int begin, int end, double rate) {
  double largest = 0;
  for (int frame = begin + 1; frame < end; ++frame)
    largest = std::max(
        largest, horizontal(path[frame + 1] - 2 * path[frame] + path[frame - 1]) * rate * rate);
  return largest;
}

class CapturedWalks : public ::testing::TestWithParam<double> {};

TEST_P(CapturedWalks, the_feet_alone_give_the_captured_path) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  int with_cycles = 0;
  for (const Walk& walk : captured("cmu-walks", GetParam())) {
    const double share = share_of_captured_path(walk, from_feet(walk));
    if (share == 0) continue;
    ++with_cycles;
    EXPECT_GE(share, 0.92) << walk.clip.name;
    EXPECT_LE(share, 1.05) << walk.clip.name;
  }
  EXPECT_GE(with_cycles, 50);
}

TEST_P(CapturedWalks, walking_backward_is_as_good) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  for (const Walk& walk : captured("cmu-walks", GetParam())) {
    const double share = share_of_captured_path(walk, from_feet(walk, true));
    if (share == 0) continue;
    EXPECT_GE(share, 0.92) << walk.clip.name;
    EXPECT_LE(share, 1.05) << walk.clip.name;
  }
}

TEST_P(CapturedWalks, no_foot_slides_more_than_the_captured_one) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  for (const Walk& walk : captured("cmu-walks", GetParam())) {
    if (walk.track.contacts.size() < 2) continue;
    const double own = foot_slide(walk.clip, walk.roles, walk.track.contacts).mean;
    EXPECT_LT(slide_of(walk, from_feet(walk)), own) << walk.clip.name;
  }
}

TEST_P(CapturedWalks, the_lowest_point_stays_at_the_ground) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  for (const Walk& walk : captured("cmu-walks", GetParam())) {
    const Path path = from_feet(walk);
    double mean = 0;
    for (int frame = 0; frame < walk.frames(); ++frame) {
      double lowest = 10;
      for (const Leg* leg : {&walk.roles.left, &walk.roles.right})
        for (const int joint : {leg->foot, leg->toes}) {
          const auto& joints = walk.clip.skeleton.joints;
          const std::size_t at =
              static_cast<std::size_t>(frame) * walk.clip.skeleton.size() + joint;
          lowest = std::min(lowest, walk.at(frame, joint).y());
          for (const auto& tip : joints[joint].tips)
            lowest = std::min(
                lowest,
                (walk.track.world.positions[at] + walk.track.world.rotations[at] * tip).y());
        }
      const double above = lowest + path[frame].y() - walk.hips(frame).y();
      mean += above / walk.frames();
      EXPECT_LT(std::abs(above), 0.05) << walk.clip.name << ", frame " << frame;
    }
    EXPECT_LT(std::abs(mean), 0.01) << walk.clip.name;
  }
}

INSTANTIATE_TEST_SUITE_P(RootMotion, CapturedWalks, ::testing::Values(0.0, 60.0, 30.0));

TEST(RootMotion, hand_overs_are_as_smooth_as_captured_hips) {
  // Clean captures, at 30 fps: the largest horizontal acceleration of each clip.
  for (const char* folder : {"bandai-namco-1", "bandai-namco-2"}) {
    GAIT_NEEDS_SHARED_DATA(folder);
    std::vector<double> ratios;
    for (const Walk& walk : captured(folder)) {
      if (walk.track.contacts.size() < 3) continue;
      const int begin = walk.track.contacts.front().frame, end = walk.track.contacts.back().frame;
      const double made = largest_acceleration(from_feet(walk), begin, end, walk.clip.frame_rate);
      ratios.push_back(made /
                       largest_acceleration(captured_path(walk), begin, end, walk.clip.frame_rate));
      EXPECT_LT(made, 30.1) << walk.clip.name;
    }
    std::sort(ratios.begin(), ratios.end());
    EXPECT_LT(ratios[ratios.size() / 2], 1.3) << folder;
    EXPECT_LT(ratios.back(), 4) << folder;
  }
}

TEST(RootMotion, walks_in_styles_keep_their_path_and_feet) {
  for (const char* folder : {"bandai-namco-1", "bandai-namco-2"}) {
    GAIT_NEEDS_SHARED_DATA(folder);
    for (const Walk& walk : captured(folder)) {
      if (walk.track.contacts.size() < 4) continue;
      const Path path = from_feet(walk);
      const double share = share_of_captured_path(walk, path);
      EXPECT_GE(share, 0.90) << walk.clip.name;  // "happy" skips along on its toes: 0.904
      EXPECT_LE(share, 1.05) << walk.clip.name;
      EXPECT_LT(slide_of(walk, path), foot_slide(walk.clip, walk.roles, walk.track.contacts).mean)
          << walk.clip.name;
    }
  }
}

TEST(RootMotion, the_path_turns_with_the_heading) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  const Walk walk = captured("cmu-walks", 30).front();
  const Path straight = from_feet(walk);
  const float heading = 2.1f;
  RootMotion root(walk.clip.skeleton, walk.roles, walk.clip.frame_rate);
  for (int frame = 0; frame < walk.frames(); ++frame) {
    const Eigen::Vector3d turned = about_vertical<double>(heading).conjugate() *
                                   root.advance(walk.pose(frame), heading).cast<double>();
    EXPECT_LT((turned - straight[frame]).norm(), 1e-4) << frame;
  }
}

TEST(RootMotion, feet_without_tips_or_toes_walk_too) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  for (Walk& walk : captured("cmu-walks", 30)) {
    const auto share = [&] { return share_of_captured_path(walk, from_feet(walk)); };
    if (share() == 0) continue;
    auto& joints = walk.clip.skeleton.joints;
    for (auto& joint : joints) joint.tips.clear();
    EXPECT_GT(share(), 0.88) << walk.clip.name << ", toe bases";
    // The toe joints go elsewhere, where they were becomes a tip of the foot.
    for (Leg* leg : {&walk.roles.left, &walk.roles.right}) {
      joints[leg->foot].tips = {joints[leg->toes].offset};
      joints[leg->toes].parent = walk.roles.hips;
      leg->toes = -1;
    }
    EXPECT_GT(share(), 0.88) << walk.clip.name << ", foot and tip";
    for (auto& joint : joints) joint.tips.clear();
    EXPECT_GT(share(), 0.6) << walk.clip.name << ", ankles";
    EXPECT_LT(share(), 1.05) << walk.clip.name << ", ankles";
  }
}

}  // namespace
}  // namespace gait
