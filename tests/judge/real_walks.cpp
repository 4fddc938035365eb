#include "judge/real_walks.h"

#include <algorithm>
#include <filesystem>

#include "gait/files/bvh.h"
#include "gait/motion/body_frame.h"
#include "shared_data.h"

namespace gait::testing {

std::vector<Walk> real_walks(const std::string& folder,
                             const std::function<bool(const std::string&)>& wanted,
                             const std::function<std::string(const std::string&)>& style) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(shared_data() / folder))
    if (entry.path().extension() == ".bvh" && wanted(entry.path().filename().string()))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Walk> walks;
  for (const auto& file : files) {
    const Clip clip = clip_from_bvh(read_bvh(file));
    Walk walk;
    walk.clip = in_metres_y_up(clip, guess_body_frame(clip, find_roles(clip.skeleton)));
    if (style) walk.style = style(file.filename().string());
    walks.push_back(std::move(walk));
  }
  return walks;
}

std::string bandai_style(const std::string& name) {
  const std::size_t begin = name.find("_walk_") + 6;
  return name.substr(begin, name.rfind('_') - begin);
}

int bandai_take(const std::string& name) { return std::stoi(name.substr(name.rfind('_') + 1, 3)); }

}  // namespace gait::testing
