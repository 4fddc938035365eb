#include "clip_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <utility>

#include "file_ending.h"
#include "gait/error.h"
#include "gait/motion/captured/looped_clip.h"
#include "gait/motion/captured/rest_rows.h"
#include "gait/motion/captured/walk_doubts.h"
#include "gait/names.h"
#include "gait/platform/path_text.h"
#include "option_kinds.h"

namespace gait::tool {

namespace {

constexpr std::size_t few_steps = 4;  // with as many, a clip is no short loop

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

std::string_view concern_named(Concern concern) {
  constexpr std::array<std::string_view, 9> names{"refused", "names",      "not walking",
                                                  "travel",  "frame rate", "unit or axes",
                                                  "bones",   "rest pose",  "file"};
  return names[static_cast<std::size_t>(concern)];
}

ReadClip read_clip(const std::filesystem::path& path, const ClipReading& reading) {
  const RoleTable table =
      reading.roles.empty() ? RoleTable{} : read_role_table(path_from_utf8(reading.roles));

  ReadClip read;
  const auto doubt = [&](Concern concern, std::string text) {
    read.doubts.push_back({concern, std::move(text)});
  };
  read.file = read_bvh(path);
  if (reading.fps) read.file.frame_time = 1 / *reading.fps;
  for (const std::string& warning : read.file.warnings) doubt(Concern::file, warning);
  const Clip whole = clip_from_bvh(read.file);
  const MovingRows rows = moving_rows(whole);
  if (auto told = rest_rows_told(whole, rows)) doubt(Concern::rest_rows, std::move(*told));
  read.first_row = rows.begin;
  const BodyForm form = body_form(rows_of(whole, rows), table);
  const Clip& in_file = form.clip;
  read.roles = find_roles(in_file, table);
  read.re_rooted = form.re_rooted;
  for (const std::string& warning : form.warnings) doubt(Concern::bones, warning);
  // What is not understood comes before what follows from it.
  if (const std::string missing = missing_roles(read.roles); !missing.empty())
    doubt(Concern::names, utf8_of(path) + ": no joint is understood as " + missing +
                              "; 'gait roles' shows what is, and -o writes a file for --roles");
  read.frame = guess_body_frame(in_file, read.roles, said_of_frame(reading));
  for (const std::string& warning : read.frame.warnings) doubt(Concern::unit_or_up, warning);
  read.clip = in_metres_y_up(in_file, read.frame);
  read.roles_without_joint = names_not_in(in_file.skeleton, table);
  if (!read.roles.has_legs()) return read;
  read.track = follow_walk(read.clip, read.roles);
  std::vector<Doubt> doubts = walk_doubts(read.clip, read.roles, *read.track);
  read.loop = steps_between(read.track->contacts).size() < few_steps && loops(read.clip);
  if (read.loop) {
    const Clip again = unrolled(read.clip, loop_passes);
    WalkTrack round = follow_walk(again, read.roles);
    doubts = walk_doubts(again, read.roles, round);
    // One pass from the middle, which has passes before it and behind.
    const int period = read.clip.frames() - 1;
    std::erase_if(round.contacts, [&](const Contact& contact) {
      return contact.frame < period || contact.frame >= 2 * period;
    });
    for (Contact& contact : round.contacts) contact.frame -= period;
    read.track = std::move(round);
  }
  for (const Doubt& of : doubts)
    doubt(of.kind == DoubtKind::not_walking ? Concern::not_walking
          : of.kind == DoubtKind::travel    ? Concern::travel
                                            : Concern::frame_rate,
          read.clip.name + ": " + of.text);
  return read;
}

void print_doubts(const std::string& command, const ReadClip& read, bool walks) {
  for (const ClipDoubt& doubt : read.doubts)
    if (walks || doubt.concern != Concern::not_walking) print_warnings(command, {doubt.text});
}

std::vector<std::filesystem::path> clips_below(const std::vector<std::string>& paths) {
  namespace fs = std::filesystem;
  std::vector<fs::path> clips;
  for (const std::string& name : paths) {
    const fs::path path = path_from_utf8(name);
    if (!fs::is_directory(path)) {
      clips.push_back(path);
      continue;
    }
    std::vector<fs::path> files;
    try {
      for (const auto& entry : fs::recursive_directory_iterator(path))
        if (ending_of(entry.path()) == ".bvh" && entry.is_regular_file())
          files.push_back(entry.path());
    } catch (const fs::filesystem_error& error) {
      throw Error(utf8_of(path) + ": cannot be searched: " + error.code().message());
    }
    if (files.empty()) throw Error(utf8_of(path) + ": has no BVH files");
    std::sort(files.begin(), files.end());
    clips.insert(clips.end(), files.begin(), files.end());
  }
  return clips;
}

void warn_of_roles(const std::string& command, const ClipReading& reading,
                   const std::vector<std::string>& without_joint) {
  if (without_joint.empty()) return;
  print_warnings(
      command, {reading.roles + ": names joints that no clip has: " + joined_names(without_joint)});
}

}  // namespace gait::tool
