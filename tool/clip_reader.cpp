#include "clip_reader.h"

#include <cctype>
#include <cstdio>

#include "gait/error.h"
#include "gait/motion/rest_rows.h"
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

void add_unit_up_and_rate(CLI::App& app, ClipReading& reading) {
  add_value(app, "--unit", "UNIT", reading.unit,
            "Unit of the files: m, cm, mm, in, ft or metres per unit (guessed from the legs)")
      ->check(CLI::Validator(unit_fault, ""));
  add_value(app, "--up", "AXIS", reading.up,
            "Axis that points up: x, y or z (guessed from the body)")
      ->transform(CLI::IsMember({"x", "y", "z"}, CLI::ignore_case));
  add_value(app, "--fps", "HZ", reading.fps,
            "Frames per second, where the files' Frame Time is wrong (the files')")
      ->check(within(1, 2000));
}

void add_clip_reading(CLI::App& app, ClipReading& reading) {
  add_unit_up_and_rate(app, reading);
  add_value(app, "--roles", "FILE", reading.roles,
            "File with lines `joint = role` for names that are not understood");
}

BvhFile read_file(const std::filesystem::path& path, const ClipReading& reading,
                  const std::string& command) {
  BvhFile file = read_bvh(path);
  print_warnings(command, file.warnings);
  if (reading.fps) file.frame_time = 1 / *reading.fps;
  return file;
}

ReadClip read_clip(const std::filesystem::path& path, const ClipReading& reading,
                   const std::string& command) {
  const RoleTable table = reading.roles.empty() ? RoleTable{} : read_role_table(reading.roles);

  ReadClip read;
  read.file = read_file(path, reading, command);
  const Clip whole = clip_from_bvh(read.file);
  const MovingRows rows = moving_rows(whole);
  if (const auto told = rest_rows_told(whole, rows)) print_warnings(command, {*told});
  read.first_row = rows.begin;
  const Clip in_file = rows_of(whole, rows);
  read.roles = find_roles(in_file.skeleton, table);
  read.frame = guess_body_frame(in_file, read.roles, said_of_frame(reading));
  print_warnings(command, read.frame.warnings);
  read.clip = in_metres_y_up(in_file, read.frame);
  read.roles_without_joint = names_not_in(in_file.skeleton, table);
  return read;
}

void warn_of_roles(const std::string& command, const ClipReading& reading,
                   const std::vector<std::string>& without_joint) {
  if (without_joint.empty()) return;
  print_warnings(
      command, {reading.roles + ": names joints that no clip has: " + joined_names(without_joint)});
}

}  // namespace gait::tool
