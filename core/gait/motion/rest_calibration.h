// Rest calibration: the same movement told by a rig whose bones rest in other directions.
//
// Two rigs of the same joints may rest differently (arms lower, head tilted), so equal local
// rotations mean different poses. Turning each joint's own frame so that its bones rest as the
// other rig's do makes rotations comparable; every joint stays exactly where it is in the world.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "gait/motion/clip.h"

namespace gait {

// Per joint of `from` the turn of its frame: it carries the directions of the bones that leave the
// joint in `to` onto those in `from`, as well as one rotation can (Kabsch 1976). Joints are matched
// by name; those without a match, or without bones of a centimetre or more, are not turned.
// Skeletons in metres.
std::vector<Eigen::Quaterniond> rest_turns(const Skeleton& from, const Skeleton& to);

// The clip as told by the turned rig: same positions of all joints in every frame.
Clip with_rest_turned(const Clip& clip, std::span<const Eigen::Quaterniond> turns);

// Both at once: the clip as a rig that rests as `to` does would tell it.
Clip calibrated(const Clip& clip, const Skeleton& to);

// A local rotation of the turned rig, as the rig it came from has it. `turns` of the joint and of
// its parent (the identity for a root).
Eigen::Quaterniond rest_turned_back(const Eigen::Quaterniond& rotation,
                                    const Eigen::Quaterniond& turn,
                                    const Eigen::Quaterniond& parent_turn);

}  // namespace gait
