#include "gait/osc/natnet_names.h"

#include <algorithm>
#include <array>

#include "gait/motion/humanoid.h"

namespace gait::osc {

namespace {

// Motive's Baseline skeleton, numbered from 1; for bridges that have sent no names.
constexpr std::array<Bone, 21> usual_numbers{Bone::hips,
                                             Bone::spine,
                                             Bone::chest,
                                             Bone::neck,
                                             Bone::head,
                                             Bone::left_shoulder,
                                             Bone::left_upper_arm,
                                             Bone::left_lower_arm,
                                             Bone::left_hand,
                                             Bone::right_shoulder,
                                             Bone::right_upper_arm,
                                             Bone::right_lower_arm,
                                             Bone::right_hand,
                                             Bone::left_upper_leg,
                                             Bone::left_lower_leg,
                                             Bone::left_foot,
                                             Bone::right_upper_leg,
                                             Bone::right_lower_leg,
                                             Bone::right_foot,
                                             Bone::left_toes,
                                             Bone::right_toes};

// "LThumb2", "LeftHandIndex1", "LeftFinger1..." after the asset's name; -1: no finger's.
int finger_named(std::string_view name) {
  Bone first = Bone::left_fingers;
  if (name.starts_with("Left"))
    name.remove_prefix(4);
  else if (name.starts_with("Right"))
    first = Bone::right_fingers, name.remove_prefix(5);
  else if (name.starts_with("L"))
    name.remove_prefix(1);
  else if (name.starts_with("R"))
    first = Bone::right_fingers, name.remove_prefix(1);
  else
    return -1;
  if (name.starts_with("Hand")) name.remove_prefix(4);
  constexpr std::array<std::string_view, 6> fingers{"Thumb", "Index", "Middle",
                                                    "Ring",  "Pinky", "Little"};
  for (std::size_t finger = 0; finger < fingers.size(); ++finger) {
    if (!name.starts_with(fingers[finger]) || name.size() != fingers[finger].size() + 1) continue;
    const int piece = name.back() - '1';
    if (piece < 0 || piece > 2) return -1;
    return index_of(first) + 3 * static_cast<int>(std::min<std::size_t>(finger, 4)) + piece;
  }
  return -1;
}

std::string_view without_asset(std::string_view name) {
  if (const std::size_t owner = name.find_last_of("_:"); owner != std::string_view::npos)
    name.remove_prefix(owner + 1);
  return name;
}

}  // namespace

std::vector<int> bones_of_names(const std::vector<std::string>& names) {
  std::vector<std::string> own;
  for (const std::string& name : names) own.emplace_back(without_asset(name));
  const std::vector<Role> roles = roles_of_names(own);
  const std::vector<int> found = bones_named(own);
  std::vector<int> bones;
  int spines = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    int bone = found[i];
    if (roles[i] == Role::spine)  // in their order, whatever they are called
      bone = spines < 3 ? index_of(Bone::spine) + spines++ : -1;
    if (bone < 0) bone = finger_named(own[i]);
    if (std::ranges::find(bones, bone) != bones.end()) bone = -1;
    bones.push_back(bone);
  }
  return bones;
}

void NatnetNames::set(std::uint32_t key, int number, std::string_view name) {
  auto skeleton = std::ranges::find(skeletons_, key, &Skeleton::key);
  if (skeleton == skeletons_.end()) {
    if (skeletons_.size() == most_skeletons) skeletons_.erase(skeletons_.begin());
    skeletons_.push_back({key, {}});
    skeleton = skeletons_.end() - 1;
  }
  std::vector<Named>& bones = skeleton->bones;
  auto at = std::ranges::lower_bound(bones, number, {}, &Named::number);
  if (at != bones.end() && at->number == number) {
    if (at->name == name) return;  // told again
    at->name = name;
  } else {
    if (bones.size() == most_bones) return;
    bones.insert(at, {number, std::string(name), -1});
  }
  std::vector<std::string> names;
  for (const Named& bone : bones) names.push_back(bone.name);
  const std::vector<int> found = bones_of_names(names);
  for (std::size_t i = 0; i < bones.size(); ++i) bones[i].bone = found[i];
}

void NatnetNames::call(std::uint32_t number, std::uint32_t name) {
  std::erase_if(aliases_, [&](const Alias& alias) { return alias.number == number; });
  if (aliases_.size() == most_skeletons) aliases_.erase(aliases_.begin());
  aliases_.push_back({number, name});
}

const NatnetNames::Skeleton* NatnetNames::find(std::uint32_t key) const noexcept {
  for (const Alias& alias : aliases_)
    if (alias.number == key) key = alias.name;
  for (const Skeleton& skeleton : skeletons_)
    if (skeleton.key == key) return &skeleton;
  return nullptr;
}

int NatnetNames::bone(std::uint32_t key, int number, bool by_number) const noexcept {
  const Skeleton* skeleton = find(key);
  if (!skeleton && by_number && skeletons_.size() == 1) skeleton = &skeletons_[0];
  if (skeleton) {
    const auto at = std::ranges::lower_bound(skeleton->bones, number, {}, &Named::number);
    // Where names are told, a number without one is a joint that has none.
    return at != skeleton->bones.end() && at->number == number ? at->bone : -1;
  }
  if (number < 1 || number > static_cast<int>(usual_numbers.size())) return -1;
  return index_of(usual_numbers[static_cast<std::size_t>(number - 1)]);
}

}  // namespace gait::osc
