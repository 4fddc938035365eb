// Rest calibration: conversion of a clip to the rest pose of another rig with the same joints.
//
// Two rigs with the same joints may have different rest poses (arms lower, head tilted), so equal
// local rotations give different poses. Rotating each joint's frame such that its bones rest as the
// other rig's do makes local rotations comparable; every joint stays where it is in the world.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "gait/motion/clip.h"

namespace gait {

// Per joint of `from` the rotation that best carries the directions of the bones below the joint in
// `to` onto those in `from` (Kabsch 1976). Joints are matched by name; joints without a match, or
// without bones of a centimetre or more, get the identity. Skeletons in metres.
std::vector<Eigen::Quaterniond> rest_turns(const Skeleton& from, const Skeleton& to);

// The clip on the rig whose joints' frames are turned: all joints keep their places in every frame.
Clip with_rest_turned(const Clip& clip, std::span<const Eigen::Quaterniond> turns);

// The clip on a rig with the rest pose of `to`: rest_turns and with_rest_turned in one call.
Clip calibrated(const Clip& clip, const Skeleton& to);

// Converts a joint's local rotation on the turned rig back to the original rig. `turn`,
// `parent_turn`: those of the joint and of its parent (the identity for a root).
Eigen::Quaterniond rest_turned_back(const Eigen::Quaterniond& rotation,
                                    const Eigen::Quaterniond& turn,
                                    const Eigen::Quaterniond& parent_turn);

}  // namespace gait
