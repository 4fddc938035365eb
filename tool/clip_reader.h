// Reading clips for a subcommand: the file, its meaning in metres with Y up, and its roles, with
// the flags that settle what a file leaves open.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gait/files/bvh.h"
#include "gait/motion/body_form.h"
#include "gait/motion/body_frame.h"
#include "gait/motion/clip.h"
#include "gait/motion/contacts.h"
#include "gait/motion/joint_roles.h"

namespace gait::tool {

// What the user says instead of the guess; empty: guessed.
struct ClipReading {
  std::string unit;           // --unit
  std::string up;             // --up
  std::string roles;          // --roles, a file
  std::optional<double> fps;  // --fps
};

// Adds --unit, --up, --fps and --roles, checked while the command line is read.
void add_clip_reading(CLI::App& app, ClipReading& reading);
// All but --roles, for what finds roles without names.
void add_unit_up_and_rate(CLI::App& app, ClipReading& reading);

BodyFrameOverride said_of_frame(const ClipReading& reading);

// To stderr, as `gait COMMAND: warning: ...`.
void print_warnings(const std::string& command, const std::vector<std::string>& warnings);

// What a doubt is about, the worst first.
enum class Concern {
  refused,
  names,
  not_walking,
  travel,
  frame_rate,
  unit_or_up,
  bones,
  rest_rows,
  file
};
std::string_view concern_named(Concern concern);  // "frame rate"

struct ClipDoubt {
  Concern concern;
  std::string text;  // with the file's name
};

struct ReadClip {
  BvhFile file;       // as it is written, but for --fps
  Clip clip;          // metres, Y up, in body form (motion/body_form.h), without rest rows
  int first_row = 0;  // the file's row that is the clip's frame 0
  JointRoles roles;
  bool re_rooted = false;  // the file's root was not the hips
  BodyFrame frame;
  std::optional<WalkTrack> track;  // where legs are known; contacts and speed of a loop go round
  bool loop = false;               // few steps, to be played again and again
  std::vector<ClipDoubt> doubts;
  std::vector<std::string> roles_without_joint;  // names of --roles that this clip does not have
};

// Passes through a loop that are learnt from in a row.
inline constexpr int loop_passes = 4;

// Reads one BVH file. Throws Error. Doubts are the caller's to tell.
ReadClip read_clip(const std::filesystem::path& path, const ClipReading& reading);

// A clip's doubts as warnings. `walks`: the command is about walking, so say what is none.
void print_doubts(const std::string& command, const ReadClip& read, bool walks);

// The files themselves, and all BVH files below those that are folders, in the order of their
// paths. Throws Error where a folder has none.
std::vector<std::filesystem::path> clips_below(const std::vector<std::string>& paths);

// A warning where --roles names joints that no clip has: misspelt, most likely.
void warn_of_roles(const std::string& command, const ClipReading& reading,
                   const std::vector<std::string>& without_joint);

}  // namespace gait::tool
