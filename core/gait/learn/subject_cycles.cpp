#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "gait/error.h"
#include "gait/learn/speed_space.h"
#include "gait/motion/contacts.h"
#include "gait/motion/rotation.h"
#include "gait/names.h"

namespace gait {

namespace {

// Bones of two people's bodies in one rig point elsewhere by up to some 20 degrees (a pelvis is
// broad or high); another rig's rest pose differs by far more.
constexpr double other_rig = 0.61;  // 35 degrees

constexpr double usual_cycle = 1.1;  // seconds: for the heading of a subject that stands

bool is_standing(const Walk& walk) {
  std::string name = std::filesystem::path(walk.clip.name).filename().string() + " " + walk.style;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return name.find("stand") != std::string::npos;
}

std::string subject_of(const Walk& walk) { return walk.subject.empty() ? "anyone" : walk.subject; }

// The body with this subject's bones. The offset of the hips is not a bone: some programs write the
// start of the walk there.
Body body_of_subject(const Body& body, const Clip& clip) {
  Body own = body;
  const int hips = body_roles(body).hips;
  const std::vector<int> below = joints_below_hips(body);
  std::string missing, turned;
  for (int i = 0; i < own.skeleton.size(); ++i) {
    Joint& joint = own.skeleton.joints[i];
    const bool bone = i != hips && std::find(below.begin(), below.end(), i) != below.end();
    const int at = clip.skeleton.find(joint.name);
    if (at < 0) {
      append_name(missing, joint.name);
      continue;
    }
    const Joint& theirs = clip.skeleton.joints[at];
    const double lengths = joint.offset.norm() * theirs.offset.norm();
    if (bone && lengths > 1e-4 && joint.offset.dot(theirs.offset) < std::cos(other_rig) * lengths)
      append_name(turned, joint.name);
    joint.offset = theirs.offset;
    joint.tips = theirs.tips;
  }
  if (!missing.empty())
    throw Error(clip.name + ": expected the body's joints; missing: " + missing);
  if (!turned.empty())
    throw Error(clip.name + ": expected bones that rest as the body's do; these differ: " + turned +
                " (another rig?)");
  return own;
}

BodyPoses poses_of(const Clip& clip, const Body& own, double cycle_seconds) {
  return body_poses(clip, own, match_joints(own, clip.skeleton, clip.name), cycle_seconds);
}

Eigen::VectorXd mean_pose(const Walk& walk, const Body& own) {
  const BodyPoses poses = poses_of(walk.clip, own, usual_cycle);
  const std::vector<int> joints = joints_below_hips(own);
  Eigen::VectorXd values(3 * static_cast<Eigen::Index>(joints.size()));
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(values.size());
  for (int frame = 0; frame < poses.frames(); ++frame) {
    pose_vector<double>(poses.pose(frame), own.references, joints,
                        {values.data(), static_cast<std::size_t>(values.size())});
    sum += values;
  }
  return sum / std::max(1, poses.frames());
}

// Closes a cycle: its drift from begin to end is subtracted evenly (G04 §5 keeps it). Both ends are
// extrapolated by half a frame to the point where they should meet.
void close(CapturedCycle& cycle, int frames) {
  const Eigen::Index size = cycle.values.size() / frames;
  const auto frame = [&](int k) { return cycle.values.segment(k * size, size); };
  const Eigen::VectorXd gap =
      1.5 * frame(frames - 1) - 0.5 * frame(frames - 2) - (1.5 * frame(0) - 0.5 * frame(1));
  for (int k = 0; k < frames; ++k) frame(k) -= gap * ((k + 0.5) / frames - 0.5);
}

}  // namespace

Body body_of_subjects(const std::vector<Walk>& walks, const RoleTable& roles) {
  if (walks.empty()) throw Error("expected at least one walk; found none");
  std::map<std::string, int> count;
  for (const Walk& walk : walks) ++count[subject_of(walk)];
  const auto most = std::max_element(
      count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const Walk& first = *std::find_if(walks.begin(), walks.end(), [&](const Walk& walk) {
    return subject_of(walk) == most->first;
  });
  Body body;
  body.skeleton = first.clip.skeleton;
  const JointRoles found = find_roles(first.clip, roles);
  if (!found.has_legs())
    throw Error(first.clip.name +
                ": expected joints for hips and for thigh, shank and foot of both legs; name them "
                "with a role table");
  body.roles = found.of_joint;
  body.roles[found.hips] = Role::hips;
  body.output_joints = found.hips_and_legs();
  for (const int joint : joints_below_hips(body))
    if (std::find(body.output_joints.begin(), body.output_joints.end(), joint) ==
        body.output_joints.end())
      body.input_joints.push_back(joint);

  constexpr double seconds_apart = 1.0 / 30;
  std::vector<std::vector<Eigen::Quaterniond>> seen(body.skeleton.joints.size());
  for (const Walk& walk : walks) {
    const BodyPoses poses = poses_of(walk.clip, body_of_subject(body, walk.clip), usual_cycle);
    const int every = std::max(1, static_cast<int>(walk.clip.frame_rate * seconds_apart));
    for (int frame = 0; frame < poses.frames(); frame += every)
      for (std::size_t joint = 0; joint < seen.size(); ++joint)
        seen[joint].push_back(poses.pose(frame)[joint]);
  }
  for (const auto& rotations : seen) body.references.push_back(chordal_mean(rotations));
  return body;
}

std::vector<SubjectCycles> cycles_of_subjects(const std::vector<Walk>& walks, const Body& body,
                                              const SpeedOptions& options) {
  std::map<std::string, std::vector<const Walk*>> by_subject;
  for (const Walk& walk : walks) by_subject[subject_of(walk)].push_back(&walk);
  std::vector<SubjectCycles> subjects;
  for (const auto& [name, of_subject] : by_subject) {
    SubjectCycles subject;
    subject.subject = name;
    const Body own = body_of_subject(body, of_subject.front()->clip);
    subject.leg_length = leg_length(own.skeleton, body_roles(own));
    std::vector<Walk> walking;
    for (const Walk* walk : of_subject)
      if (is_standing(*walk))
        subject.standing = mean_pose(*walk, own);
      else
        walking.push_back(*walk);
    subject.cycles = cut_cycles(walking, own, options.frames, options.roles);
    const auto bent = std::partition(subject.cycles.begin(), subject.cycles.end(),
                                     [](const CapturedCycle& cycle) { return cycle.straight; });
    if (bent != subject.cycles.begin()) subject.cycles.erase(bent, subject.cycles.end());
    for (CapturedCycle& cycle : subject.cycles) close(cycle, options.frames);
    if (!subject.cycles.empty()) subjects.push_back(std::move(subject));
  }
  return subjects;
}

}  // namespace gait
