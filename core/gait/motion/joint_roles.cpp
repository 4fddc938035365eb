#include "gait/motion/joint_roles.h"

#include <algorithm>
#include <set>
#include <utility>

#include "gait/error.h"
#include "gait/motion/roles/joint_names.h"
#include "gait/motion/roles/tree_roles.h"
#include "gait/names.h"
#include "gait/platform/path_text.h"
#include "gait/platform/whole_file.h"

namespace gait {
namespace {

constexpr std::array<std::pair<Role, std::string_view>, 21> role_names{{
    {Role::none, "none"},
    {Role::hips, "hips"},
    {Role::spine, "spine"},
    {Role::neck, "neck"},
    {Role::head, "head"},
    {Role::left_shoulder, "left shoulder"},
    {Role::left_arm, "left arm"},
    {Role::left_forearm, "left forearm"},
    {Role::left_hand, "left hand"},
    {Role::right_shoulder, "right shoulder"},
    {Role::right_arm, "right arm"},
    {Role::right_forearm, "right forearm"},
    {Role::right_hand, "right hand"},
    {Role::left_thigh, "left thigh"},
    {Role::left_shank, "left shank"},
    {Role::left_foot, "left foot"},
    {Role::left_toes, "left toes"},
    {Role::right_thigh, "right thigh"},
    {Role::right_shank, "right shank"},
    {Role::right_foot, "right foot"},
    {Role::right_toes, "right toes"},
}};

std::string letters_of(std::string_view text) {
  std::string letters;
  for (const char c : text)
    if (c >= 'A' && c <= 'Z')
      letters += static_cast<char>(c - 'A' + 'a');
    else if (c >= 'a' && c <= 'z')
      letters += c;
  return letters;
}

bool descends(const Skeleton& skeleton, int joint, int from) {
  for (joint = skeleton.joints[joint].parent; joint >= 0; joint = skeleton.joints[joint].parent)
    if (joint == from) return true;
  return false;
}

int common_ancestor(const Skeleton& skeleton, int a, int b) {
  for (int joint = skeleton.joints[a].parent; joint >= 0; joint = skeleton.joints[joint].parent)
    if (descends(skeleton, b, joint)) return joint;
  return -1;
}

// A joint of a leg that does not hang on the one above it is something else of a similar name.
void drop_unless_below(const Skeleton& skeleton, JointRoles& roles, Role role, Role above,
                       const std::vector<bool>& said) {
  const int upper = roles.joint(above);
  if (upper < 0) return;
  for (int joint = 0; joint < skeleton.size(); ++joint)
    if (roles.of_joint[joint] == role && !said[joint] && !descends(skeleton, joint, upper))
      roles.of_joint[joint] = Role::none;
}

bool is_trunk_or_arm(Role role) { return role >= Role::spine && role < Role::left_thigh; }

bool holds_trunk(const Skeleton& skeleton, const JointRoles& roles, int hips) {
  for (int joint = 0; joint < skeleton.size(); ++joint)
    if (is_trunk_or_arm(roles.of_joint[joint]) && descends(skeleton, joint, hips)) return true;
  return false;
}

// The hips hold both legs; of several that do, those that hold the trunk as well.
void choose_hips(const Skeleton& skeleton, JointRoles& roles, const std::vector<bool>& said,
                 const std::vector<NamedRole>& named) {
  const int left = roles.left.thigh, right = roles.right.thigh;
  int chosen = -1, best = -1;
  for (int joint = 0; joint < skeleton.size(); ++joint) {
    if (roles.of_joint[joint] != Role::hips) continue;
    const bool holds_legs = left >= 0 && right >= 0 && descends(skeleton, left, joint) &&
                            descends(skeleton, right, joint);
    const int fits = said[joint] ? 8
                                 : 4 * holds_legs + 2 * holds_trunk(skeleton, roles, joint) +
                                       !named[joint].vague;
    if (fits > best) chosen = joint, best = fits;
  }
  RoleSource source = chosen >= 0 ? roles.from[chosen] : RoleSource::tree;
  if (left >= 0 && right >= 0 && best < 4)
    if (const int joint = common_ancestor(skeleton, left, right); joint >= 0) {
      chosen = joint;
      source = RoleSource::tree;
    }
  for (Role& role : roles.of_joint)
    if (role == Role::hips) role = Role::none;
  if (chosen >= 0) {
    roles.of_joint[chosen] = Role::hips;
    roles.from[chosen] = source;
  }
  roles.hips = chosen;
}

void set_legs(JointRoles& roles) {
  roles.left = {roles.joint(Role::left_thigh), roles.joint(Role::left_shank),
                roles.joint(Role::left_foot), roles.joint(Role::left_toes)};
  roles.right = {roles.joint(Role::right_thigh), roles.joint(Role::right_shank),
                 roles.joint(Role::right_foot), roles.joint(Role::right_toes)};
}

// Whether names and table leave a part of the body open.
bool leave_open(const JointRoles& roles) {
  for (const Role role : {Role::spine, Role::head, Role::left_arm, Role::left_forearm,
                          Role::right_arm, Role::right_forearm, Role::left_thigh, Role::left_shank,
                          Role::left_foot, Role::right_thigh, Role::right_shank, Role::right_foot})
    if (roles.joint(role) < 0) return true;
  return false;
}

// Sets the roles in the table; names then no longer decide about these roles.
std::vector<bool> apply_table(const Skeleton& skeleton, const RoleTable& table, JointRoles& roles) {
  std::vector<bool> said(skeleton.joints.size(), false);
  std::vector<Role> given;
  for (int joint = 0; joint < skeleton.size(); ++joint)
    if (const auto entry = table.find(skeleton.joints[joint].name); entry != table.end()) {
      roles.of_joint[joint] = entry->second;
      roles.from[joint] = RoleSource::table;
      said[joint] = true;
      given.push_back(entry->second);
    }
  for (int joint = 0; joint < skeleton.size(); ++joint)
    if (!said[joint] && std::ranges::count(given, roles.of_joint[joint]) > 0)
      roles.of_joint[joint] = Role::none;
  return said;
}

}  // namespace

std::string_view role_name(Role role) { return role_names[static_cast<std::size_t>(role)].second; }

std::optional<Role> role_from_name(std::string_view name) {
  const std::string letters = letters_of(name);
  for (const auto& [role, known] : role_names)
    if (letters_of(known) == letters) return role;
  return std::nullopt;
}

int JointRoles::joint(Role role) const {
  const auto found = std::ranges::find(of_joint, role);
  return found == of_joint.end() ? -1 : static_cast<int>(found - of_joint.begin());
}

std::vector<int> JointRoles::hips_and_legs() const {
  std::vector<int> joints;
  for (std::size_t joint = 0; joint < of_joint.size(); ++joint)
    if (static_cast<int>(joint) == hips || in_leg[joint]) joints.push_back(static_cast<int>(joint));
  return joints;
}

double leg_length(const Skeleton& skeleton, const JointRoles& roles) {
  double length = 0;
  for (int joint = roles.left.foot; joint >= 0 && joint != roles.left.thigh && joint != roles.hips;
       joint = skeleton.joints[joint].parent)
    length += skeleton.joints[joint].offset.norm();
  return length;
}

JointRoles find_roles(const Skeleton& skeleton, const RoleTable& table) {
  Clip at_rest;
  at_rest.skeleton = skeleton;
  return find_roles(at_rest, table);
}

JointRoles find_roles(const Clip& clip, const RoleTable& table) {
  const Skeleton& skeleton = clip.skeleton;
  const std::vector<NamedRole> named = roles_from_names(skeleton);
  JointRoles roles;
  std::vector<Side> sides;
  for (const NamedRole& name : named) {
    roles.of_joint.push_back(name.role);
    roles.from.push_back(name.role == Role::none ? RoleSource::none : RoleSource::name);
    sides.push_back(name.side);
  }
  const std::vector<bool> said = apply_table(skeleton, table, roles);

  for (const auto& [thigh, shank, foot, toes] :
       {std::array{Role::left_thigh, Role::left_shank, Role::left_foot, Role::left_toes},
        std::array{Role::right_thigh, Role::right_shank, Role::right_foot, Role::right_toes}}) {
    drop_unless_below(skeleton, roles, shank, thigh, said);
    drop_unless_below(skeleton, roles, foot, shank, said);
    drop_unless_below(skeleton, roles, toes, foot, said);
  }
  if (leave_open(roles)) add_roles_from_tree(clip, roles, said, sides);
  set_legs(roles);
  choose_hips(skeleton, roles, said, named);
  for (std::size_t joint = 0; joint < roles.from.size(); ++joint)
    if (roles.of_joint[joint] == Role::none && !said[joint]) roles.from[joint] = RoleSource::none;

  roles.in_leg.assign(skeleton.joints.size(), false);
  // What was turned over onto the hips (motion/body_form.h) cannot be known without them.
  for (int joint = 0; joint < skeleton.size(); ++joint)
    if (roles.hips >= 0 && skeleton.joints[joint].parent == roles.hips &&
        !skeleton.joints[joint].sits_at.empty())
      roles.in_leg[joint] = true;
  for (const int thigh : {roles.left.thigh, roles.right.thigh}) {
    if (thigh < 0) continue;
    for (int joint = 0; joint < skeleton.size(); ++joint)
      if (joint == thigh || descends(skeleton, joint, thigh)) roles.in_leg[joint] = true;
    if (roles.hips < 0 || !descends(skeleton, thigh, roles.hips)) continue;
    for (int joint = skeleton.joints[thigh].parent; joint != roles.hips;
         joint = skeleton.joints[joint].parent)
      if (roles.of_joint[joint] == Role::none) roles.in_leg[joint] = true;
  }
  return roles;
}

std::vector<Role> roles_of_names(std::span<const std::string> names) {
  Skeleton alone;
  for (const std::string& name : names) alone.joints.emplace_back().name = name;
  // A tree would leave out shanks and toes that hang on no thigh: here nothing hangs on anything.
  const std::vector<NamedRole> named = roles_from_names(alone);
  const bool hips = std::ranges::find(named, Role::hips, &NamedRole::role) != named.end();
  std::vector<Role> roles;
  for (const NamedRole& joint : named)
    roles.push_back(joint.vague && !hips ? Role::hips : joint.role);
  return roles;
}

std::string missing_roles(const JointRoles& roles) {
  std::string missing;
  for (const Role role : {Role::hips, Role::left_thigh, Role::left_shank, Role::left_foot,
                          Role::right_thigh, Role::right_shank, Role::right_foot})
    if (roles.joint(role) < 0) append_name(missing, std::string(role_name(role)));
  return missing;
}

std::string role_table_text(const Skeleton& skeleton, const JointRoles& roles) {
  std::string text = "# joint = role; roles:";
  for (const auto& [role, name] : role_names)
    text += (role == Role::none ? " " : ", ") + std::string(name);
  text += "\n";
  std::set<std::string> written;
  for (int joint = 0; joint < skeleton.size(); ++joint)
    if (const std::string& name = skeleton.joints[joint].name;
        name.find('#') == std::string::npos && written.insert(name).second)
      text += name + " = " + std::string(role_name(roles.of_joint[joint])) + "\n";
  return text;
}

std::vector<std::string> names_not_in(const Skeleton& skeleton, const RoleTable& table) {
  std::vector<std::string> names;
  for (const auto& entry : table)
    if (skeleton.find(entry.first) < 0) names.push_back(entry.first);
  return names;
}

RoleTable parse_role_table(std::string_view text, const std::string& name) {
  const auto trimmed = [](std::string_view part) {
    const std::size_t begin = part.find_first_not_of(" \t\r");
    return begin == std::string_view::npos
               ? std::string_view{}
               : part.substr(begin, part.find_last_not_of(" \t\r") - begin + 1);
  };
  RoleTable table;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const std::string here = name + ":" + std::to_string(number) + ": ";
    const std::size_t equals = line.rfind('=');
    if (equals == std::string_view::npos)
      throw Error(here + "expected 'joint = role', found '" + std::string(line) + "'");
    const std::string joint(trimmed(line.substr(0, equals)));
    const std::string_view role = trimmed(line.substr(equals + 1));
    if (joint.empty()) throw Error(here + "expected a joint's name before '=', found none");
    const std::optional<Role> known = role_from_name(role);
    if (!known) {
      const auto name_of = [](const auto& entry) { return entry.second; };
      throw Error(here + "expected a role (" + joined_names(role_names, name_of) + "), found '" +
                  std::string(role) + "'");
    }
    if (!table.emplace(joint, *known).second)
      throw Error(here + "expected each joint once, found '" + joint + "' again");
  }
  return table;
}

RoleTable read_role_table(const std::filesystem::path& path) {
  return parse_role_table(read_whole_file(path, "a table of roles"), utf8_of(path));
}

}  // namespace gait
