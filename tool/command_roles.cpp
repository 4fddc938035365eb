// gait roles: what is understood of a rig's joints.
#include <cstdio>
#include <string>
#include <vector>

#include "clip_reader.h"
#include "commands.h"
#include "gait/files/whole_file.h"
#include "json_report.h"
#include "option_kinds.h"

namespace gait::tool {

namespace {

struct RolesOptions {
  std::string clip, output;
  bool json = false;
  ClipReading reading;
};

const char* source_words(RoleSource source) {
  switch (source) {
    case RoleSource::name:
      return "its name";
    case RoleSource::tree:
      return "its place";
    case RoleSource::table:
      return "--roles";
    default:
      return "";
  }
}

int depth_of(const Skeleton& skeleton, int joint) {
  int depth = 0;
  while ((joint = skeleton.joints[joint].parent) >= 0) ++depth;
  return depth;
}

// Columns, not bytes: names may be in any script.
std::string padded(const std::string& text, std::size_t width) {
  std::size_t letters = 0;
  for (const char c : text) letters += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return text + std::string(letters < width ? width - letters : 1, ' ');
}

void print_table(const std::string& path, const ReadClip& read) {
  const Skeleton& skeleton = read.clip.skeleton;
  int understood = 0;
  for (const Role role : read.roles.of_joint) understood += role != Role::none;
  std::printf("%s\n  %d joints, %d with a role", path.c_str(), skeleton.size(), understood);
  if (read.roles.has_legs()) std::printf(", %.3f m of leg", leg_length(skeleton, read.roles));
  std::printf("\n");
  if (read.re_rooted)
    std::printf("  the file's root is %s; the body is taken to hang on its hips\n",
                read.file.skeleton.joints.front().name.c_str());
  std::printf("  %s%s%s\n", padded("joint", 36).c_str(), padded("role", 16).c_str(), "from");
  for (int joint = 0; joint < skeleton.size(); ++joint) {
    const Role role = read.roles.of_joint[joint];
    const std::string name = std::string(static_cast<std::size_t>(depth_of(skeleton, joint)), ' ') +
                             skeleton.joints[joint].name;
    std::printf("  %s%s%s\n", padded(name, 36).c_str(),
                padded(role == Role::none ? "-" : std::string(role_name(role)), 16).c_str(),
                source_words(read.roles.from[joint]));
  }
}

nlohmann::ordered_json as_json(const std::string& path, const ReadClip& read) {
  nlohmann::ordered_json joints = nlohmann::ordered_json::array();
  for (int joint = 0; joint < read.clip.skeleton.size(); ++joint) {
    const Joint& one = read.clip.skeleton.joints[joint];
    joints.push_back({{"joint", one.name},
                      {"parent", one.parent < 0 ? "" : read.clip.skeleton.joints[one.parent].name},
                      {"role", role_name(read.roles.of_joint[joint])},
                      {"from", source_words(read.roles.from[joint])}});
  }
  return {{"clip", path},
          {"legs_understood", read.roles.has_legs()},
          {"missing", missing_roles(read.roles)},
          {"root_turned_over", read.re_rooted},
          {"leg_length", leg_length(read.clip.skeleton, read.roles)},
          {"joints", joints}};
}

void roles(const RolesOptions& options) {
  const ReadClip read = read_clip(options.clip, options.reading, "roles");
  warn_of_roles("roles", options.reading, read.roles_without_joint);
  if (options.json)
    print_report(as_json(options.clip, read));
  else
    print_table(options.clip, read);
  if (!options.output.empty())
    write_whole_file(options.output, role_table_text(read.clip.skeleton, read.roles));
}

void add_options(CLI::App& app, RolesOptions& options) {
  add_argument(app, "CLIP", options.clip, "BVH file");
  add_value(app, "-o,--output", "FILE", options.output,
            "File of roles to write, a line `joint = role` for each joint: edit it and give it to "
            "--roles");
  add_json_flag(app, options.json);
  add_clip_reading(app, options.reading);
  app.footer(R"(Roles come from all names of a rig together, then from the places of its joints.

Examples:
  gait roles walk.bvh
  gait roles walk.bvh -o rig.txt       then edit rig.txt
  gait label walk.bvh --roles rig.txt)");
}

}  // namespace

Command roles_command(CLI::App& program) {
  return make_command(program, "roles", "Show which joint is understood as what", add_options,
                      roles);
}

}  // namespace gait::tool
