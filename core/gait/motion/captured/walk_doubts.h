// Doubts about a captured clip: a frame rate at which nobody walks, and motion that is no walking.
//
// Every threshold lies well outside what 142 captured walks of 25 styles and 10 subjects show.
#pragma once

#include <string>
#include <vector>

#include "gait/motion/clip.h"
#include "gait/motion/contacts.h"
#include "gait/motion/joint_roles.h"

namespace gait {

enum class DoubtKind { not_walking, travel, frame_rate };  // the worst first

struct Doubt {
  DoubtKind kind;
  std::string text;  // what is doubtful and why, without the clip's name
};

// `clip` in metres with Y up, `track` of it. Clips too short to tell (below eight frames) give
// none.
std::vector<Doubt> walk_doubts(const Clip& clip, const JointRoles& roles, const WalkTrack& track);

// The doubts of one kind, with the clip's name before them, as warnings.
std::vector<std::string> doubts_told(const std::vector<Doubt>& doubts, const std::string& clip);

}  // namespace gait
