// Where real motion lies, for tests that use it when it is there.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace gait::testing {

inline std::filesystem::path shared_data() { return GAIT_SHARED_DATA; }

}  // namespace gait::testing

// First line of a test on real data: skips, saying so, where the data is not.
#define GAIT_NEEDS_SHARED_DATA(folder)                                   \
  if (!std::filesystem::exists(gait::testing::shared_data() / (folder))) \
  GTEST_SKIP() << "no real motion beside the project (" << (folder) << "): nothing to test on"
