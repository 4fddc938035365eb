// A manifest: a CSV table that says which style, subject and speed each clip has.
//
//   file,style,subject,speed
//   takes/anna_03.bvh,proud,Anna,1.31
//   "takes/anna, again.bvh",sad,Anna,
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "name_pattern.h"

namespace gait::tool {

struct ManifestEntry {
  std::filesystem::path file;  // found from the manifest's folder
  NameFields fields;
  int line = 0;
};

struct Manifest {
  std::vector<ManifestEntry> entries;
  std::vector<std::string> warnings;  // columns that are not known
};

// The first line names the columns, in any order; `file` must be there. Fields may stand in double
// quotes, a quote within is doubled. Throws Error with file and line.
Manifest read_manifest(const std::filesystem::path& path);

}  // namespace gait::tool
