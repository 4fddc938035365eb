// From a clip to a model's body: which of its joints are meant, and its poses with heading out.
#pragma once

#include <span>
#include <vector>

#include "gait/model/model.h"
#include "gait/motion/clip.h"
#include "gait/motion/rotation.h"

namespace gait {

// The model's body. Throws Error when it has none.
const Body& required_body(const Model& model);

// One per joint of the body, in the precision of playing.
std::vector<Eigen::Quaternionf> float_references(const Body& body);

// Largest angle between a clip's and a body's rest direction of a bone (radians) that still counts
// as the same rig: 10 degrees for the bones of arms and legs, whose rest tells how the rig's frames
// lie. From trunk to head, to the arms and to the thighs it is 35: there the rest is a person's
// shape, and between two subjects of one rig (CMU's) up to 28 degrees differ.
inline constexpr double rest_direction_limit = 0.17453;
inline constexpr double shape_direction_limit = 0.61087;

// For each joint of the body the index of the clip's joint of that name. Throws Error naming the
// joints that `skeleton` lacks, or whose rest directions differ by more than the limit. `needed`
// restricts what is asked for (indices into the body's joints; empty: all).
std::vector<int> match_joints(const Body& body, const Skeleton& skeleton, const std::string& clip,
                              const std::vector<int>& needed = {});

// Poses of the body's joints, frame after frame: local rotations, the hips' in the world with
// heading out. Unmatched joints (-1) keep their references.
struct BodyPoses {
  int joints = 0;
  std::vector<Eigen::Quaterniond> rotations;
  std::vector<double> heading;  // per frame, radians, as taken out

  int frames() const { return joints == 0 ? 0 : static_cast<int>(rotations.size()) / joints; }
  std::span<const Eigen::Quaterniond> pose(int frame) const {
    return {rotations.data() + static_cast<std::size_t>(frame) * joints,
            static_cast<std::size_t>(joints)};
  }
};

// `clip` in metres, Y up. Heading is centred over a cycle or, when the hips are an input, causal as
// the player's.
BodyPoses body_poses(const Clip& clip, const Body& body, const std::vector<int>& matched,
                     double cycle_seconds);

// Roles of the body's joints as find_roles gives them for a skeleton.
JointRoles body_roles(const Body& body);
// The names of its hips and legs, by which a file of the same rig is brought into body form.
RoleTable hips_and_legs_of(const Body& body);

// The same as the clip counts its joints, `clip_joints` of them; `matched` as match_joints gives
// it.
JointRoles matched_roles(const Body& body, const std::vector<int>& matched, int clip_joints);

// A clip of the body with `frames` frames at rest: what place_body fills.
Clip body_clip(const Body& body, const std::string& name, double frame_rate, int frames);

// Puts a pose with heading out back into the world: hips turned to `heading` and moved to `hips`
// (metres), whatever joints are above them. `pose`: one rotation per joint of the body.
void place_body(Clip& clip, int frame, const JointRoles& roles,
                std::span<const Eigen::Quaterniond> pose, double heading,
                const Eigen::Vector3d& hips);

// Writes the three values of a joint: its rotation vector relative to the reference.
template <typename Scalar>
void values_from(const Quaternion<Scalar>& rotation, const Quaternion<Scalar>& reference,
                 Scalar* values) noexcept {
  const Vector3<Scalar> vector = rotation_vector<Scalar>(reference.conjugate() * rotation);
  values[0] = vector.x(), values[1] = vector.y(), values[2] = vector.z();
}

// And back: the rotation of a joint from its three values.
template <typename Scalar>
Quaternion<Scalar> rotation_from(std::span<const Scalar, 3> values,
                                 const Quaternion<Scalar>& reference) noexcept {
  return reference * exponential_map<Scalar>(Vector3<Scalar>(values[0], values[1], values[2]));
}

// Pose vector: per joint of `joints` the rotation vector relative to its reference, three values
// each. `pose` has one rotation per joint of the body.
template <typename Scalar>
void pose_vector(std::span<const Quaternion<Scalar>> pose,
                 std::span<const Quaternion<Scalar>> references, std::span<const int> joints,
                 std::span<Scalar> values) noexcept {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto joint = static_cast<std::size_t>(joints[i]);
    values_from<Scalar>(pose[joint], references[joint], values.data() + 3 * i);
  }
}

// The same of all joints.
template <typename Scalar>
void pose_vector(std::span<const Quaternion<Scalar>> pose,
                 std::span<const Quaternion<Scalar>> references,
                 std::span<Scalar> values) noexcept {
  for (std::size_t joint = 0; joint < pose.size(); ++joint)
    values_from<Scalar>(pose[joint], references[joint], values.data() + 3 * joint);
}

// And back: the rotations of all joints.
template <typename Scalar>
void pose_from(std::span<const Scalar> values, std::span<const Quaternion<Scalar>> references,
               std::span<Quaternion<Scalar>> pose) noexcept {
  for (std::size_t joint = 0; joint < pose.size(); ++joint)
    pose[joint] =
        rotation_from<Scalar>(values.subspan(3 * joint).template first<3>(), references[joint]);
}

}  // namespace gait
