// Foot slide: how far the foot that should stand travels over the ground, in millimetres per
// stance.
#pragma once

#include <vector>

#include "gait/motion/clip.h"
#include "gait/motion/joint_roles.h"
#include "gait/motion/steps.h"

namespace gait {

struct FootSlide {
  std::vector<double> stances;  // mm, one per step, in time
  double mean = 0;              // mm per stance; 0 when there is none
};

// For each step (from one foot's contact to the other's) the travel of the foot that began it: in
// each frame its lowest point is sought among the foot joint, all joints below it and all their
// tips, and the horizontal distance that this point covers from the frame before is added up. Where
// another point became the lowest, that frame adds nothing: rolling from heel to toe is no slide.
// Distances are added as they are, back and forth counting twice.
//
// `clip` in metres, Y up; `contacts` in time (frames of the clip), as follow_walk gives them. Only
// steps between contacts of different feet count. Throws Error when a foot has no joint or a
// contact lies outside the clip.
FootSlide foot_slide(const Clip& clip, const JointRoles& roles,
                     const std::vector<Contact>& contacts);

}  // namespace gait
