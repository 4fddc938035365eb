// Reading clips for a subcommand: the file, its meaning in metres with Y up, and its roles, with
// the flags that settle what a file leaves open.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "gait/files/bvh.h"
#include "gait/motion/body_form.h"
#include "gait/motion/body_frame.h"
#include "gait/motion/clip.h"
#include "gait/motion/joint_roles.h"

namespace gait::tool {

// What the user says instead of the guess; empty: guessed.
struct ClipReading {
  std::string unit;   // --unit
  std::string up;     // --up
  std::string roles;  // --roles, a file
};

// Adds --unit, --up and --roles, checked while the command line is read.
void add_clip_reading(CLI::App& app, ClipReading& reading);
// --unit and --up alone, for what finds roles without names.
void add_unit_and_up(CLI::App& app, ClipReading& reading);

BodyFrameOverride said_of_frame(const ClipReading& reading);

// To stderr, as `gait COMMAND: warning: ...`.
void print_warnings(const std::string& command, const std::vector<std::string>& warnings);

struct ReadClip {
  BvhFile file;  // as it is written
  Clip clip;     // metres, Y up, in body form (motion/body_form.h)
  JointRoles roles;
  bool re_rooted = false;  // the file's root was not the hips
  BodyFrame frame;
  std::vector<std::string> roles_without_joint;  // names of --roles that this clip does not have
};

// Reads one BVH file. Warnings go to stderr as `gait COMMAND: warning: ...`. Throws Error.
ReadClip read_clip(const std::filesystem::path& path, const ClipReading& reading,
                   const std::string& command);

// A warning where --roles names joints that no clip has: misspelt, most likely.
void warn_of_roles(const std::string& command, const ClipReading& reading,
                   const std::vector<std::string>& without_joint);

}  // namespace gait::tool
