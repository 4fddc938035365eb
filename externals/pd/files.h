// Files that messages name: found as Pd finds them, written beside the patch.
#pragma once

#include <m_pd.h>

#include <optional>
#include <string>

namespace gait::pd {

// The path of a file beside the patch or on Pd's search path; nothing when there is none.
inline std::optional<std::string> find_file(const t_glist* patch, const std::string& name) {
  char folder[MAXPDSTRING], *file = nullptr;
  const int found = canvas_open(patch, name.c_str(), "", folder, &file, MAXPDSTRING, 1);
  if (found < 0) return std::nullopt;
  sys_close(found);
  return std::string(folder) + "/" + file;
}

// The error when there is none.
inline std::string no_file(const std::string& name) {
  return "no file '" + name + "' beside the patch or on Pd's path";
}

// The path of a file to be written; one without a folder lies beside the patch.
inline std::string path_to_write(const t_glist* patch, const std::string& name) {
  char path[MAXPDSTRING];
  canvas_makefilename(patch, name.c_str(), path, MAXPDSTRING);
  return path;
}

}  // namespace gait::pd
