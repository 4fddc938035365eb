// NatNet names: which bone of a humanoid a NatNet bridge means by a number of a skeleton.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gait::osc {

// Bones of a rig by its joints' names, which are understood as a set: Motive's `LShoulder` is the
// collar bone beside `LUArm`, and `LeftShoulder` of its BVH naming is the upper arm. An asset's
// name and underscore before a joint's are passed over. -1: no bone, or one that an earlier name
// has.
std::vector<int> bones_of_names(const std::vector<std::string>& names);

// All names that bridges have told, for a bounded number of skeletons.
class NatnetNames {
 public:
  static constexpr std::size_t most_skeletons = 16, most_bones = 256;

  // A bone's name. `skeleton`: the key of the skeleton's number or name.
  void set(std::uint32_t skeleton, int number, std::string_view name);
  // A skeleton's name for its number: bones are told by the name, and moved by the number in some
  // modes of the bridge.
  void call(std::uint32_t number, std::uint32_t name);
  // -1: no bone. Motive's usual numbering when no name was told. `by_number`: the key is of the
  // skeleton's number; where only one skeleton has told its names, it is that one.
  int bone(std::uint32_t skeleton, int number, bool by_number = false) const noexcept;

 private:
  struct Named {
    int number;
    std::string name;
    int bone;
  };
  struct Skeleton {
    std::uint32_t key;
    std::vector<Named> bones;  // ascending numbers
  };
  const Skeleton* find(std::uint32_t key) const noexcept;

  std::vector<Skeleton> skeletons_;
  struct Alias {
    std::uint32_t number, name;
  };
  std::vector<Alias> aliases_;
};

}  // namespace gait::osc
