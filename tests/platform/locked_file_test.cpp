// Journals: one owner, all of a record or nothing.
#include "gait/platform/locked_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "gait/platform/path_text.h"
#include "gait/platform/whole_file.h"

namespace gait {
namespace {

namespace fs = std::filesystem;

class LockedFiles : public ::testing::Test {
 protected:
  LockedFiles() { fs::remove(path_); }
  ~LockedFiles() override { fs::remove(path_); }
  const fs::path path_ = path_from_utf8(::testing::TempDir()) / "gait_locked_fürs Erste.takes";
  std::error_code failure_;
};

TEST_F(LockedFiles, have_one_owner) {
  auto first = LockedFile::open(path_, failure_);
  ASSERT_TRUE(first) << failure_.message();
  EXPECT_FALSE(LockedFile::open(path_, failure_));
  EXPECT_EQ(failure_, std::errc::device_or_resource_busy);
  first.reset();
  EXPECT_TRUE(LockedFile::open(path_, failure_)) << failure_.message();
  EXPECT_FALSE(failure_);
}

TEST_F(LockedFiles, grow_at_the_end_and_can_be_read_meanwhile) {
  write_whole_file(path_, "one ");
  const auto file = LockedFile::open(path_, failure_);
  ASSERT_TRUE(file);
  EXPECT_EQ(file->size(), 4u);
  EXPECT_FALSE(file->append("two "));
  EXPECT_FALSE(file->append("three"));
  EXPECT_EQ(read_whole_file(path_, "a file"), "one two three");
  EXPECT_EQ(file->size(), 13u);
}

TEST_F(LockedFiles, keep_their_lock_under_another_name) {
  const fs::path aside = fs::path(path_) += ".1";
  auto file = LockedFile::open(path_, failure_);
  ASSERT_TRUE(file);
  ASSERT_FALSE(file->rename(aside));
  EXPECT_EQ(file->path(), aside);
  EXPECT_FALSE(LockedFile::open(aside, failure_));
  EXPECT_TRUE(LockedFile::open(path_, failure_)) << "the old name is free again";
  EXPECT_FALSE(file->append("x"));
  EXPECT_EQ(read_whole_file(aside, "a file"), "x");
  EXPECT_FALSE(file->remove());
  EXPECT_FALSE(fs::exists(aside));
}

TEST_F(LockedFiles, say_why_they_cannot_be_opened_or_written) {
  EXPECT_FALSE(LockedFile::open(path_ / "none", failure_));
  EXPECT_EQ(failure_, std::errc::no_such_file_or_directory) << failure_.message();
#ifdef __linux__
  const auto full = LockedFile::open("/dev/full", failure_);
  ASSERT_TRUE(full) << failure_.message();
  EXPECT_EQ(full->append("x"), std::errc::no_space_on_device);
#endif
}

}  // namespace
}  // namespace gait
