// A walk as rotations of a model's joints: clip players play it, recordings become one.
//
// Units: metres, seconds, radians; Y up.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "gait/files/label_file.h"
#include "gait/model/body_pose.h"
#include "gait/model/model.h"
#include "gait/motion/clip.h"
#include "gait/motion/steps.h"

namespace gait {

struct BodyMotion {
  std::string name;        // where it comes from
  double frame_rate = 30;  // its own, not the model's
  int joints = 0;
  // Frame after frame, one per joint of the body: local rotations, the hips' in the world with
  // heading out. Joints the clip lacks keep their references.
  std::vector<Eigen::Quaternionf> rotations;
  std::vector<Eigen::Vector3f> hips;    // one per frame: their place in the world
  std::vector<float> heading;           // one per frame, unwrapped
  std::vector<Contact> contacts;        // in the order of frames
  std::vector<LabelSegment> labels;     // by their start
  std::vector<std::string> warnings{};  // what was odd but usable

  int frames() const { return static_cast<int>(hips.size()); }
  double length() const { return frames() / frame_rate; }  // seconds
  std::span<const Eigen::Quaternionf> pose(int frame) const {
    return {rotations.data() + static_cast<std::size_t>(frame) * joints,
            static_cast<std::size_t>(joints)};
  }
};

// A clip in metres, Y up, on the model's body. Heading is out as a player of that model has it:
// causal at the model's rate where the hips are measured, centred over the walk's own cycle
// elsewhere. `labels`: what a label file says; contacts are its steps, and found in the motion
// where it has none. Without labels they are the steps. Throws Error when the model has no body,
// joints are missing or rest otherwise (match_joints), or steps overlap.
BodyMotion motion_on_body(const Clip& clip, const Model& model,
                          std::vector<LabelSegment> labels = {});

// Reads a BVH file, and the label file beside it (same name, .txt or .lab) if there is one. Throws
// Error as reading and motion_on_body do, and where there are no frames.
BodyMotion read_motion(const std::filesystem::path& path, const Model& model);

// Gives a motion that has none its contacts, and its steps as labels. None without legs.
void find_steps(BodyMotion& motion, const Body& body);

// Back to a clip, on the body's own bones.
Clip clip_of(const BodyMotion& motion, const Body& body);

}  // namespace gait
