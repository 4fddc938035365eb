#include "gait/motion/joint_names.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace gait {
namespace {

enum class Side { none, left, right };

// Part of the body in a name; the last four depend on the other names of the same side.
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
  hip_or_thigh,     // thigh, unless the rig has a joint of that name: then only its mount
  leg,              // shank, unless a shank by another name hangs on it
  shoulder_or_arm,  // collar bone, unless the rig has no other upper arm
  foot_or_toes,     // foot, unless it hangs on an ankle
};

struct Name {
  Side side = Side::none;
  Part part = Part::unknown;
};

constexpr std::array<std::pair<std::string_view, Part>, 21> middle{{
    {"hips", Part::hips},       {"hip", Part::hips},
    {"pelvis", Part::hips},     {"hipcenter", Part::hips},
    {"spine", Part::spine},     {"spinebase", Part::spine},
    {"spinemid", Part::spine},  {"spineshoulder", Part::spine},
    {"chest", Part::spine},     {"upperchest", Part::spine},
    {"torso", Part::spine},     {"thorax", Part::spine},
    {"abdomen", Part::spine},   {"ab", Part::spine},
    {"lowerback", Part::spine}, {"upperback", Part::spine},
    {"waist", Part::spine},     {"neck", Part::neck},
    {"lowerneck", Part::neck},  {"upperneck", Part::neck},
    {"head", Part::head},
}};

constexpr std::array<std::pair<std::string_view, Part>, 43> sided{{
    {"collar", Part::shoulder},   {"clavicle", Part::shoulder}, {"shoulder", Part::shoulder_or_arm},
    {"arm", Part::arm},           {"uparm", Part::arm},         {"upperarm", Part::arm},
    {"uarm", Part::arm},          {"humerus", Part::arm},       {"forearm", Part::forearm},
    {"lowerarm", Part::forearm},  {"lowarm", Part::forearm},    {"loarm", Part::forearm},
    {"farm", Part::forearm},      {"elbow", Part::forearm},     {"radius", Part::forearm},
    {"hand", Part::hand},         {"wrist", Part::hand},        {"upleg", Part::thigh},
    {"upperleg", Part::thigh},    {"uleg", Part::thigh},        {"thigh", Part::thigh},
    {"femur", Part::thigh},       {"hip", Part::hip_or_thigh},  {"leg", Part::leg},
    {"lowerleg", Part::shank},    {"lowleg", Part::shank},      {"loleg", Part::shank},
    {"lleg", Part::shank},        {"knee", Part::shank},        {"shin", Part::shank},
    {"calf", Part::shank},        {"tibia", Part::shank},       {"shank", Part::shank},
    {"foot", Part::foot_or_toes}, {"ankle", Part::foot},        {"toe", Part::toes},
    {"toes", Part::toes},         {"toebase", Part::toes},      {"ball", Part::toes},
    {"forefoot", Part::toes},     {"foreleg", Part::unknown},   {"collarbone", Part::shoulder},
    {"clav", Part::shoulder},
}};

template <std::size_t size>
Part look_up(const std::array<std::pair<std::string_view, Part>, size>& table,
             std::string_view word) {
  for (const auto& [known, part] : table)
    if (known == word) return part;
  return Part::unknown;
}

bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
char lower(char c) { return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c; }

struct Word {
  std::string text;      // lower case, no digits
  bool separate = true;  // begins after a separator, not just a capital letter
};

// "mixamorig:LeftUpLeg1" -> left, up, leg. What stands before the last colon is a name space.
std::vector<Word> words_of(std::string_view name) {
  if (const std::size_t colon = name.rfind(':'); colon != std::string_view::npos)
    name.remove_prefix(colon + 1);
  std::vector<Word> words;
  bool separate = true, in_word = false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!is_lower(c) && !is_upper(c)) {
      in_word = false;
      separate = separate || !is_digit(c);
      continue;
    }
    // A capital begins a word after a small letter, and as the last of several ("LHip": L, Hip).
    if (in_word && is_upper(c) &&
        (is_lower(name[i - 1]) || (i + 1 < name.size() && is_lower(name[i + 1]))))
      in_word = false;
    if (!in_word) words.push_back({{}, separate});
    words.back().text += lower(c);
    in_word = true;
    separate = false;
  }
  return words;
}

Side side_of(std::string_view word) {
  if (word == "left" || word == "l") return Side::left;
  if (word == "right" || word == "r") return Side::right;
  return Side::none;
}

// Helpers of animators, and ends of bones: no part of the body moves by them.
bool is_helper(std::string_view word) {
  constexpr std::array<std::string_view, 11> helpers{
      "end", "nub", "tip", "ik", "pole", "target", "top", "ctrl", "goal", "effector", "fk"};
  return std::ranges::find(helpers, word) != helpers.end();
}

// A name in one word: "lfemur", "leftupleg", "handleft".
Name name_in_one_word(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, Side>, 4> sides{
      {{"left", Side::left}, {"right", Side::right}, {"l", Side::left}, {"r", Side::right}}};
  for (const auto& [text, side] : sides) {
    if (word.starts_with(text))
      if (const Part part = look_up(sided, word.substr(text.size())); part != Part::unknown)
        return {side, part};
    if (text.size() > 1 && word.ends_with(text))
      if (const Part part = look_up(sided, word.substr(0, word.size() - text.size()));
          part != Part::unknown)
        return {side, part};
  }
  return {};
}

Name name_meant(std::string_view joint) {
  // Segments of the spine in Xsens' own naming.
  for (const std::string_view segment : {"L5", "L3", "T12", "T8"})
    if (joint == segment) return {Side::none, Part::spine};

  // MakeHuman puts a mount before some joints, named as the joint after two underscores.
  if (joint.starts_with("__")) return {};
  std::vector<Word> words = words_of(joint);
  if (std::ranges::any_of(words, [](const Word& word) { return is_helper(word.text); })) return {};
  Side side = Side::none;
  if (const auto found = std::ranges::find_if(
          words, [](const Word& word) { return side_of(word.text) != Side::none; });
      found != words.end()) {
    side = side_of(found->text);
    const bool separate = found->separate;
    const auto next = words.erase(found);
    if (next != words.end()) next->separate = next->separate || separate;
  }
  while (words.size() > 1 && (words.back().text == "roll" || words.back().text == "twist"))
    words.pop_back();

  // The whole name first; then without what stands before a separator: "Bip01_Pelvis".
  for (std::size_t first = 0; first < words.size(); ++first) {
    if (!words[first].separate) continue;
    std::string text;
    for (std::size_t i = first; i < words.size(); ++i) text += words[i].text;
    if (side == Side::none) {
      if (const Part part = look_up(middle, text); part != Part::unknown) return {side, part};
      if (const Name name = name_in_one_word(text); name.part != Part::unknown) return name;
    } else if (const Part part = look_up(sided, text); part != Part::unknown) {
      return {side, part};
    }
  }
  return {};
}

struct PartRoles {
  Part part;
  Role right, left;
};

constexpr std::array<PartRoles, 12> part_roles{{
    {Part::hips, Role::hips, Role::hips},
    {Part::spine, Role::spine, Role::spine},
    {Part::neck, Role::neck, Role::neck},
    {Part::head, Role::head, Role::head},
    {Part::shoulder, Role::right_shoulder, Role::left_shoulder},
    {Part::arm, Role::right_arm, Role::left_arm},
    {Part::forearm, Role::right_forearm, Role::left_forearm},
    {Part::hand, Role::right_hand, Role::left_hand},
    {Part::thigh, Role::right_thigh, Role::left_thigh},
    {Part::shank, Role::right_shank, Role::left_shank},
    {Part::foot, Role::right_foot, Role::left_foot},
    {Part::toes, Role::right_toes, Role::left_toes},
}};

Role role_of(Side side, Part part) {
  const auto roles = std::ranges::find(part_roles, part, &PartRoles::part);
  if (roles == part_roles.end()) return Role::none;
  return side == Side::left ? roles->left : roles->right;
}

bool any_above(const Skeleton& skeleton, const std::vector<Name>& names, int joint, Part part) {
  const Side side = names[joint].side;
  for (int above = skeleton.joints[joint].parent; above >= 0; above = skeleton.joints[above].parent)
    if (names[above].side == side && names[above].part == part) return true;
  return false;
}

// Decides the names that mean different things in different rigs.
Part settled(const Skeleton& skeleton, const std::vector<Name>& names, int joint) {
  const Name name = names[joint];
  const auto rig_has = [&](Part part) {
    return std::ranges::any_of(
        names, [&](const Name& other) { return other.side == name.side && other.part == part; });
  };
  switch (name.part) {
    case Part::hip_or_thigh:
      return rig_has(Part::thigh) ? Part::unknown : Part::thigh;
    case Part::leg:
      if (rig_has(Part::thigh) || any_above(skeleton, names, joint, Part::hip_or_thigh))
        return Part::shank;
      return rig_has(Part::shank) ? Part::thigh : Part::shank;
    case Part::shoulder_or_arm:
      return rig_has(Part::arm) ? Part::shoulder : Part::arm;
    case Part::foot_or_toes:
      return any_above(skeleton, names, joint, Part::foot) && !rig_has(Part::toes) ? Part::toes
                                                                                   : Part::foot;
    default:
      return name.part;
  }
}

}  // namespace

std::vector<Role> roles_from_names(const Skeleton& skeleton) {
  std::vector<Name> names;
  for (const Joint& joint : skeleton.joints) names.push_back(name_meant(joint.name));
  std::vector<Role> roles;
  for (int joint = 0; joint < skeleton.size(); ++joint)
    roles.push_back(role_of(names[joint].side, settled(skeleton, names, joint)));
  return roles;
}

}  // namespace gait
