// A small BVH file as text, for tests that bend it.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace gait::testing {

// Line 1 is HIERARCHY, line 27 `Frames: 3`, line 29 the first row; 12 values a row.
inline constexpr std::string_view small_bvh = R"(HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Spine
  {
    OFFSET 0.5 10 -0.25
    CHANNELS 3 Xrotation Yrotation Zrotation
    End Site
    {
      OFFSET 0 8 0
    }
  }
  JOINT LeftUpLeg
  {
    OFFSET 4 -1 0
    CHANNELS 3 Yrotation Zrotation Xrotation
    End Site
    {
      OFFSET 0 -40 0
    }
  }
}

MOTION
Frames: 3
Frame Time: 0.0333333
1 90 2 10 20 30 1 2 3 -5 -6 -7
1.5 91 2.25 11 21 31 2 3 4 -4 -5 -6
2 92 2.5 12 22 32 3 4 5 -3 -4 -5
)";

inline std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string result(text);
  for (std::size_t at = result.find(from); at != std::string::npos;
       at = result.find(from, at + to.size()))
    result.replace(at, from.size(), to);
  return result;
}

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::vector<std::filesystem::path> bvh_files_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".bvh") files.push_back(entry.path());
  return files;
}

// A folder of its own, gone with the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "gait-test-XXXXXX").string();
    if (mkdtemp(pattern.data())) path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace gait::testing
