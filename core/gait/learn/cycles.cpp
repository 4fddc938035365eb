#include "gait/learn/cycles.h"

#include <algorithm>
#include <cmath>

#include "gait/error.h"
#include "gait/motion/contacts.h"
#include "gait/motion/rotation.h"

namespace gait {

namespace {

// Pose between two frames of a walk, `at` in frames.
void pose_at(const BodyPoses& poses, double at, std::vector<Eigen::Quaterniond>& pose) {
  const int before = std::clamp(static_cast<int>(std::floor(at)), 0, poses.frames() - 1);
  const int after = std::min(before + 1, poses.frames() - 1);
  for (std::size_t joint = 0; joint < pose.size(); ++joint)
    pose[joint] =
        slerp(poses.pose(before)[joint], poses.pose(after)[joint], std::max(0.0, at - before));
}

// Distance along the heading between two frames.
double travelled(const WalkTrack& track, int joints, int hips, int begin, int end) {
  Eigen::Vector3d moved = track.world.positions[static_cast<std::size_t>(end) * joints + hips] -
                          track.world.positions[static_cast<std::size_t>(begin) * joints + hips];
  moved.y() = 0;
  return moved.norm();
}

}  // namespace

std::vector<int> joints_below_hips(const Body& body) {
  const int hips = body_roles(body).hips;
  std::vector<int> joints;
  for (int joint = 0; joint < body.skeleton.size(); ++joint) {
    bool below = false;
    for (int at = joint; at >= 0 && !below; at = body.skeleton.joints[at].parent)
      below = at == hips;
    if (below) joints.push_back(joint);
  }
  return joints;
}

std::vector<CapturedCycle> cut_cycles(const std::vector<Walk>& walks, const Body& body, int frames,
                                      const RoleTable& roles) {
  if (frames < 2 || frames % 2 != 0)
    throw Error("expected an even number of frames per cycle; found " + std::to_string(frames));
  const std::vector<int> joints = joints_below_hips(body);
  std::vector<CapturedCycle> cycles;
  std::vector<Eigen::Quaterniond> pose(body.skeleton.joints.size());
  for (std::size_t i = 0; i < walks.size(); ++i) {
    const Clip& clip = walks[i].clip;
    const std::vector<int> matched = match_joints(body, clip.skeleton, clip.name);
    const JointRoles clip_roles = find_roles(clip, roles);
    WalkTrack track = follow_walk(clip, clip_roles);
    if (!walks[i].contacts.empty()) track.contacts = walks[i].contacts;
    const std::vector<Cycle> straight = straight_cycles(track);
    const BodyPoses poses = body_poses(clip, body, matched, track.cycle_seconds);
    int place = 0;
    for (std::size_t c = 0; c + 2 < track.contacts.size(); ++c) {
      const Contact &right = track.contacts[c], &left = track.contacts[c + 1],
                    &end = track.contacts[c + 2];
      if (right.foot != Foot::right || left.foot != Foot::left || end.foot != Foot::right) continue;
      CapturedCycle cycle;
      cycle.walk = static_cast<int>(i);
      cycle.place = place++;
      cycle.duration = (end.frame - right.frame) / clip.frame_rate;
      cycle.leg_length = track.leg_length;
      cycle.speed = track.treadmill ? track.speed
                                    : travelled(track, clip.skeleton.size(), clip_roles.hips,
                                                right.frame, end.frame) /
                                          cycle.duration;
      cycle.straight = std::any_of(straight.begin(), straight.end(),
                                   [&](const Cycle& known) { return known.begin == right.frame; });
      cycle.values.resize(static_cast<Eigen::Index>(frames * 3 * joints.size()));
      for (int k = 0; k < frames; ++k) {
        const double phase = 2.0 * k / frames;
        const double at = phase < 1 ? right.frame + phase * (left.frame - right.frame)
                                    : left.frame + (phase - 1) * (end.frame - left.frame);
        pose_at(poses, at, pose);
        pose_vector<double>(pose, body.references, joints,
                            {cycle.values.data() + k * 3 * joints.size(), 3 * joints.size()});
      }
      cycles.push_back(std::move(cycle));
    }
  }
  return cycles;
}

}  // namespace gait
