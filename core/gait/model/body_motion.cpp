#include "gait/model/body_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/motion/body_form.h"
#include "gait/motion/body_frame.h"
#include "gait/motion/contacts.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/resample.h"

namespace gait {

namespace {

// As reconstruction asks for them: joints that are neither may be missing.
std::vector<int> needed_joints(const Body& body) {
  std::vector<int> joints = body.input_joints;
  joints.insert(joints.end(), body.output_joints.begin(), body.output_joints.end());
  return joints;
}

bool measures_hips(const Body& body) {
  return std::any_of(body.input_joints.begin(), body.input_joints.end(),
                     [&](int joint) { return body.roles[joint] == Role::hips; });
}

void unwrap(std::vector<double>& angles) {
  for (std::size_t i = 1; i < angles.size(); ++i)
    angles[i] = angles[i - 1] + std::remainder(angles[i] - angles[i - 1], 2 * std::numbers::pi);
}

// A player sees measured hips at the model's rate and takes the heading out there: frames between
// two of the model's have a heading between theirs.
std::vector<double> heading_at_rate(const Clip& clip, const Body& body,
                                    const std::vector<int>& matched, double model_rate) {
  std::vector<double> coarse =
      body_poses(resampled(clip, model_rate), body, matched, body.heading_window).heading;
  unwrap(coarse);
  const int last = static_cast<int>(coarse.size()) - 1;
  std::vector<double> heading(clip.frames());
  for (int frame = 0; frame < clip.frames(); ++frame) {
    const double at = std::min<double>(frame * model_rate / clip.frame_rate, last);
    const int before = static_cast<int>(at);
    const int after = std::min(before + 1, last);
    heading[frame] = coarse[before] + (at - before) * (coarse[after] - coarse[before]);
  }
  return heading;
}

BodyPoses poses_on_body(const Clip& clip, const Model& model, const std::vector<int>& matched,
                        double cycle_seconds) {
  const Body& body = *model.body;
  BodyPoses poses = body_poses(clip, body, matched, cycle_seconds);
  if (measures_hips(body) && clip.frames() > 0 &&
      std::abs(clip.frame_rate / model.frame_rate - 1) > 1e-4) {
    const std::vector<double> heading = heading_at_rate(clip, body, matched, model.frame_rate);
    const int hips = body_roles(body).hips;
    for (int frame = 0; frame < clip.frames(); ++frame) {
      Eigen::Quaterniond& rotation =
          poses.rotations[static_cast<std::size_t>(frame) * poses.joints + hips];
      rotation = about_vertical(poses.heading[frame] - heading[frame]) * rotation;
    }
    poses.heading = heading;
  }
  unwrap(poses.heading);
  return poses;
}

void check_contacts(const BodyMotion& motion) {
  for (const Contact& contact : motion.contacts)
    if (contact.frame > motion.frames())
      throw Error("expected steps within its " + std::to_string(motion.length()) +
                  " s, found one that ends at " +
                  std::to_string(contact.frame / motion.frame_rate) + " s");
}

}  // namespace

BodyMotion motion_on_body(const Clip& clip, const Model& model, std::vector<LabelSegment> labels) {
  const Body& body = required_body(model);
  const std::vector<int> matched =
      match_joints(body, clip.skeleton, clip.name, needed_joints(body));
  const JointRoles roles = matched_roles(body, matched, clip.skeleton.size());
  WalkTrack track;
  if (roles.has_legs()) track = follow_walk(clip, roles);
  const BodyPoses poses = poses_on_body(clip, model, matched, track.cycle_seconds);

  BodyMotion motion;
  motion.name = clip.name;
  motion.frame_rate = clip.frame_rate;
  motion.joints = poses.joints;
  motion.rotations.reserve(poses.rotations.size());
  for (const Eigen::Quaterniond& rotation : poses.rotations)
    motion.rotations.push_back(rotation.cast<float>());
  motion.heading.assign(poses.heading.begin(), poses.heading.end());
  motion.hips.assign(clip.frames(), Eigen::Vector3f::Zero());
  if (roles.hips >= 0) {
    const WorldPoses world = world_poses(clip);
    for (int frame = 0; frame < clip.frames(); ++frame)
      motion.hips[frame] =
          world.positions[static_cast<std::size_t>(frame) * clip.skeleton.size() + roles.hips]
              .cast<float>();
  }
  motion.contacts = contacts_from_labels(labels, clip.frame_rate);
  check_contacts(motion);
  if (motion.contacts.empty()) motion.contacts = track.contacts;
  if (labels.empty()) labels = labels_from_contacts(motion.contacts, clip.frame_rate);
  std::ranges::stable_sort(labels, {}, &LabelSegment::start);
  motion.labels = std::move(labels);
  return motion;
}

BodyMotion read_motion(const std::filesystem::path& path, const Model& model) {
  const BvhFile file = read_bvh(path);
  const Body& body = required_body(model);
  const BodyForm form = body_form(clip_from_bvh(file), hips_and_legs_of(body));
  const Clip& in_file = form.clip;
  if (in_file.frames() == 0) throw Error(file.name + ": expected frames to play, found none");
  const JointRoles roles =
      matched_roles(body, match_joints(body, in_file.skeleton, file.name, needed_joints(body)),
                    in_file.skeleton.size());
  const BodyFrame frame = guess_body_frame(in_file, roles);
  const Clip clip = in_metres_y_up(in_file, frame);

  std::vector<LabelSegment> labels;
  std::string labels_name;
  for (const char* ending : {".txt", ".lab"}) {
    const auto beside = std::filesystem::path(path).replace_extension(ending);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(beside, ignored)) continue;
    labels_name = beside.string();
    labels = read_labels(beside).segments;
    break;
  }
  BodyMotion motion;
  try {
    motion = motion_on_body(clip, model, std::move(labels));
  } catch (const Error& error) {
    const std::string text = error.what();
    const bool of_labels = !labels_name.empty() && !text.starts_with(file.name);
    throw Error((of_labels ? labels_name + ": " : "") + text);
  }
  motion.warnings = file.warnings;
  motion.warnings.insert(motion.warnings.end(), form.warnings.begin(), form.warnings.end());
  motion.warnings.insert(motion.warnings.end(), frame.warnings.begin(), frame.warnings.end());
  return motion;
}

void find_steps(BodyMotion& motion, const Body& body) {
  const JointRoles roles = body_roles(body);
  if (!roles.has_legs()) return;
  motion.contacts = follow_walk(clip_of(motion, body), roles).contacts;
  motion.labels = labels_from_contacts(motion.contacts, motion.frame_rate);
}

Clip clip_of(const BodyMotion& motion, const Body& body) {
  const JointRoles roles = body_roles(body);
  Clip clip = body_clip(body, motion.name, motion.frame_rate, motion.frames());
  std::vector<Eigen::Quaterniond> pose(body.skeleton.joints.size());
  for (int frame = 0; frame < motion.frames(); ++frame) {
    for (std::size_t joint = 0; joint < pose.size(); ++joint)
      pose[joint] = motion.pose(frame)[joint].cast<double>().normalized();
    if (roles.hips < 0)
      std::copy(pose.begin(), pose.end(), clip.pose(frame).begin());
    else
      place_body(clip, frame, roles, pose, motion.heading[frame],
                 motion.hips[frame].cast<double>());
  }
  return clip;
}

}  // namespace gait
