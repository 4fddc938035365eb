// Words of joint names: side and part of the body that names say. Private to finding roles.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gait {

enum class Side { none, left, right };

// Part of the body in a name; the last ones depend on the other names of the rig.
enum class Part {
  unknown,
  hips,
  spine,
  neck,
  head,
  shoulder,
  arm,
  forearm,
  hand,
  thigh,
  shank,
  foot,
  toes,
  centre,           // hips, unless the rig has others
  hip_or_thigh,     // thigh, unless the rig has a joint of that name: then only its mount
  leg,              // shank, unless a shank by another name hangs on it
  shoulder_or_arm,  // collar bone, unless the rig has no other upper arm
  foot_or_toes,     // foot, unless it hangs on an ankle
};

struct NameMeaning {
  Side side = Side::none;
  Part part = Part::unknown;
  bool twist = false;  // a twist or roll joint of that part
};

// What the names of one rig mean, one for each. What all names share (a name space, an asset's
// name, '_JNT') says nothing of any.
std::vector<NameMeaning> meanings_of(std::span<const std::string_view> names);

// The part that a whole word stands for, with or without a side: "hips", "thigh", "oberarm".
Part part_named(std::string_view word, bool sided);

}  // namespace gait
