// Walks from files for a subcommand: which BVH files are meant, and what is known of each: style,
// subject and speed from its name or a manifest, contacts from a label file beside it.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "clip_reader.h"
#include "gait/learn/walk_sequences.h"

namespace gait::tool {

struct WalkReading {
  std::vector<std::string> paths;  // BVH files, or folders that are searched for them
  std::string pattern;             // --label
  std::string manifest;            // --manifest
  bool no_labels = false;          // --no-labels
  bool calibrate = false;          // --calibrate
  ClipReading clip;
};

// Adds CLIPS_OR_DIRS, --label, --manifest, --no-labels, --calibrate and what reads a clip.
void add_walk_reading(CLI::App& app, WalkReading& reading);

// How names are read, for the end of a --help.
extern const char* const label_help;

struct WalkFile {
  std::filesystem::path path;
  std::string remark;  // where its style and contacts come from
};

struct WalksRead {
  std::vector<Walk> walks;
  std::vector<WalkFile> files;  // one per walk
  RoleTable roles;
};

// Reads all of them, in the order they were named, a folder's in the order of their paths; a file
// that is named twice is read once. `progress` is called before each with the share done and the
// file; what it throws ends the reading. Throws UsageError when no clips are named, Error when
// a file cannot be read.
WalksRead read_walks(const WalkReading& reading, const std::string& command,
                     const std::function<void(double, const std::string&)>& progress);

}  // namespace gait::tool
