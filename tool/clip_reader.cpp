#include "clip_reader.h"

#include <cctype>
#include <cstdio>

#include "gait/error.h"
#include "gait/names.h"
#include "option_kinds.h"

namespace gait::tool {

namespace {

std::string unit_fault(const std::string& unit) {
  try {
    metres_per_unit_named(unit);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace

void print_warnings(const std::string& command, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings)
    std::fprintf(stderr, "gait %s: warning: %s\n", command.c_str(), warning.c_str());
}

BodyFrameOverride said_of_frame(const ClipReading& reading) {
  BodyFrameOverride said;
  if (!reading.unit.empty()) said.metres_per_unit = metres_per_unit_named(reading.unit);
  if (!reading.up.empty()) said.up_axis = reading.up[0];
  return said;
}

void add_unit_and_up(CLI::App& app, ClipReading& reading) {
  add_value(app, "--unit", "UNIT", reading.unit,
            "Unit of the files: m, cm, mm, in, ft or metres per unit (guessed from the legs)")
      ->check(CLI::Validator(unit_fault, ""));
  add_value(app, "--up", "AXIS", reading.up,
            "Axis that points up: x, y or z (guessed from the body)")
      ->transform(CLI::IsMember({"x", "y", "z"}, CLI::ignore_case));
}

void add_clip_reading(CLI::App& app, ClipReading& reading) {
  add_unit_and_up(app, reading);
  add_value(app, "--roles", "FILE", reading.roles,
            "File with lines `joint = role` for names that are not understood");
}

ReadClip read_clip(const std::filesystem::path& path, const ClipReading& reading,
                   const std::string& command) {
  const RoleTable table = reading.roles.empty() ? RoleTable{} : read_role_table(reading.roles);

  ReadClip read;
  read.file = read_bvh(path);
  print_warnings(command, read.file.warnings);
  const BodyForm form = body_form(clip_from_bvh(read.file), table);
  read.roles = find_roles(form.clip, table);
  read.re_rooted = form.re_rooted;
  // What is not understood comes before what follows from it.
  if (const std::string missing = missing_roles(read.roles); !missing.empty())
    print_warnings(command, {path.string() + ": no joint is understood as " + missing +
                             "; 'gait roles' shows what is, and -o writes a file for --roles"});
  print_warnings(command, form.warnings);
  read.frame = guess_body_frame(form.clip, read.roles, said_of_frame(reading));
  print_warnings(command, read.frame.warnings);
  read.clip = in_metres_y_up(form.clip, read.frame);
  read.roles_without_joint = names_not_in(form.clip.skeleton, table);
  return read;
}

void warn_of_roles(const std::string& command, const ClipReading& reading,
                   const std::vector<std::string>& without_joint) {
  if (without_joint.empty()) return;
  print_warnings(
      command, {reading.roles + ": names joints that no clip has: " + joined_names(without_joint)});
}

}  // namespace gait::tool
