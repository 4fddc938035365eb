// Body form: a clip's rig as all that follows expects it. Bones are the skeleton's offsets, and all
// of the body hangs on the hips.
//
// Files may hold their bones in position channels (an OFFSET then says nothing), and may have their
// root at the head or the chest. Frames of joints stay as they are in the world; a joint between
// the root and the hips sits, in the new tree, at the place of the joint below it in the file: the
// bone that it turns is the one between the two.
#pragma once

#include <string>
#include <vector>

#include "gait/motion/clip.h"
#include "gait/motion/joint_roles.h"

namespace gait {

struct BodyForm {
  Clip clip;                       // in the unit and axes of the file
  std::vector<int> joint_in_file;  // per joint of the clip
  bool re_rooted = false;
  // Per joint of the file: its position channels are added to its OFFSET, against the usual.
  std::vector<bool> adds_to_offset;
  std::vector<std::string> warnings;  // joints that truly move against their parents
};

// `clip`: as clip_from_bvh gives it. `table`: as for find_roles, in the file's names. A rig without
// known hips keeps its root.
BodyForm body_form(Clip clip, const RoleTable& table = {});

// Whether a joint was turned over: the body hung on it in the file, and it hangs on the hips now.
inline bool is_turned_over(const Joint& joint) { return !joint.sits_at.empty(); }

}  // namespace gait
