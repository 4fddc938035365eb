// Files by every name, whole or not at all, with the system's own reason where it refuses.
#include "gait/platform/whole_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "gait/error.h"
#include "gait/platform/path_text.h"

namespace gait {
namespace {

namespace fs = std::filesystem;

class WholeFiles : public ::testing::Test {
 protected:
  WholeFiles() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~WholeFiles() override { fs::remove_all(folder_); }

  static std::string error_of(const std::function<void()>& work) {
    try {
      work();
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  const fs::path folder_ = path_from_utf8(::testing::TempDir()) / "gait_whole_files";
};

TEST_F(WholeFiles, are_found_by_names_of_any_language) {
  for (const std::string name : {"Schritt für Schritt.bvh", "歩く.bvh", "хо\xCC\x86дьба 'x'.bvh"}) {
    const fs::path path = folder_ / path_from_utf8(name);
    write_whole_file(path, name);
    EXPECT_EQ(read_whole_file(path, "a file"), name);
    EXPECT_EQ(utf8_of(path.filename()), name);
    EXPECT_EQ(path_from_utf8(utf8_of(path)), path);
  }
  int files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_)) ++files;
  EXPECT_EQ(files, 3) << "nothing else may be left";
}

#ifdef __linux__
// There a name is bytes; an old disk may hold names in Latin-1.
TEST_F(WholeFiles, are_found_by_names_that_are_not_utf8) {
  const std::string name =
      "f\xFC"
      "r.txt";
  const fs::path path = folder_ / path_from_utf8(name);
  write_whole_file(path, "x");
  EXPECT_EQ(utf8_of(fs::directory_iterator(folder_)->path().filename()), name);
}

TEST_F(WholeFiles, say_that_the_disk_is_full_and_leave_the_old_file) {
  write_whole_file(folder_ / "model", "old");
  fs::create_symlink("/dev/full", folder_ / "model.part");
  for (const std::size_t size : {10, 1000000}) {
    const std::string error =
        error_of([&] { write_whole_file(folder_ / "model", std::string(size, 'x')); });
    EXPECT_NE(error.find("/model: cannot be written: No space left on device"), std::string::npos)
        << error;
    EXPECT_EQ(read_whole_file(folder_ / "model", "a file"), "old");
    fs::create_symlink("/dev/full", folder_ / "model.part");
  }
}
#endif

TEST_F(WholeFiles, say_why_they_cannot_be_opened) {
  const auto refused = [&](const char* name) {
    return error_of([&] { read_whole_file(folder_ / name, "a BVH file"); });
  };
  EXPECT_NE(refused("none").find("/none: expected a BVH file, cannot open it: No such file"),
            std::string::npos)
      << refused("none");
  fs::create_directory(folder_ / "folder");
  EXPECT_NE(refused("folder").find("/folder: expected a BVH file, found a folder"),
            std::string::npos);
  EXPECT_NE(error_of([&] { write_whole_file(folder_ / "none" / "x", ""); }).find("no folder"),
            std::string::npos);
}

TEST_F(WholeFiles, are_refused_above_their_largest_size) {
  write_whole_file(folder_ / "large", std::string((3 << 20) + 1, 'x'));
  EXPECT_EQ(read_whole_file(folder_ / "large", "a file", (3 << 20) + 1).size(), (3u << 20) + 1);
  EXPECT_NE(error_of([&] {
              read_whole_file(folder_ / "large", "a file", 3 << 20);
            }).find("of at most 3 MiB, found a larger one"),
            std::string::npos);
}

TEST_F(WholeFiles, replace_one_that_is_being_read) {
  write_whole_file(folder_ / "model", "old");
  std::ifstream reader = open_to_read(folder_ / "model", "a file");
  write_whole_file(folder_ / "model", "new");
  std::string seen;
  reader >> seen;
  EXPECT_EQ(seen, "old");
  EXPECT_EQ(read_whole_file(folder_ / "model", "a file"), "new");
}

}  // namespace
}  // namespace gait
