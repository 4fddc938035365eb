// The archive for Pd's package finder: unpacked into an empty home, a patch runs from there.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "patches/patch.h"

namespace gait::testing {
namespace {

namespace fs = std::filesystem;

int run(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()); }

TEST(Package, runs_from_an_empty_home) {
  GAIT_NEEDS_PD();
  ASSERT_EQ(run("cmake --build " GAIT_BUILD " --target deken"), 0);
  fs::path archive;
  for (const auto& entry : fs::directory_iterator(GAIT_BUILD "/deken"))
    if (entry.path().extension() == ".dek") archive = entry.path();
  ASSERT_FALSE(archive.empty());
  const std::string name = archive.filename().string();
  EXPECT_TRUE(name.starts_with("gait[v")) << name;
  EXPECT_NE(name.find("-32)(Linux-"), std::string::npos) << name;
  EXPECT_TRUE(fs::exists(archive.string() + ".txt"));
  EXPECT_TRUE(fs::exists(archive.string() + ".sha256"));

  std::string home = ::testing::TempDir() + "gait_home_XXXXXX";
  ASSERT_NE(mkdtemp(home.data()), nullptr);
  const fs::path extra = fs::path(home) / ".local/lib/pd/extra";
  fs::create_directories(extra);
  ASSERT_EQ(run("cd '" + extra.string() + "' && cmake -E tar xf '" + archive.string() + "'"), 0);
  for (const char* file : {"gait.pd_linux", "gait-demo.gait", "LICENSE", "README.md"})
    EXPECT_TRUE(fs::exists(extra / "gait" / file)) << file;

  Patch patch;
  patch.declare("-lib gait");
  patch.object("gait.model gait-demo -blocking");
  const int walker = patch.object("gait.pca");
  const int seen = patch.object("print SEEN");
  patch.connect(walker, 0, seen);
  patch.at_start({"bang"}, walker);
  patch.quit_after(10);
  const PdRun walked = run_pd(patch, {.home = home, .state = "", .watched = false});
  EXPECT_EQ(walked.exit_code, 0) << walked.log;
  EXPECT_EQ(walked.errors(), std::vector<std::string>()) << walked.log;
  EXPECT_NE(walked.log.find("SEEN: pose "), std::string::npos) << walked.log;
}

// What a module asks Pd for tells its numbers: Pd for 64-bit floats makes classes by another name.
TEST(Package, has_a_module_for_each_size_of_float) {
  if (run("command -v nm") != 0) GTEST_SKIP() << "there is no nm here (Debian: binutils)";
  const auto asks = [](const std::string& module, const std::string& symbol) {
    return run("nm -D --undefined-only '" + module + "' | grep -qw " + symbol) == 0;
  };
  std::string wide;
  for (const auto& entry : fs::directory_iterator(GAIT_PD_FOLDER))
    if (entry.path().string().ends_with("-64.so")) wide = entry.path().string();
  ASSERT_FALSE(wide.empty());
  const std::string narrow = GAIT_PD_FOLDER "/gait.pd_linux";
  EXPECT_TRUE(asks(narrow, "class_new"));
  EXPECT_FALSE(asks(narrow, "class_new64"));
  EXPECT_TRUE(asks(wide, "class_new64"));
  EXPECT_FALSE(asks(wide, "class_new"));
  // And nothing is seen of them but their entries.
  EXPECT_NE(run("nm -D --defined-only '" + narrow +
                "' | grep -v ' gait_setup\\| setup_gait' | grep -q ' T '"),
            0);
}

}  // namespace
}  // namespace gait::testing
