// Every help patch and example opens without an error, and looks as it should; every object has
// one.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "patches/patch.h"
#include "patches/patch_file.h"

namespace gait::testing {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> patches() {
  std::vector<fs::path> files;
  for (const char* folder : {"help_patches", "examples"})
    if (fs::exists(fs::path(GAIT_SOURCE) / folder))
      for (const auto& entry : fs::recursive_directory_iterator(fs::path(GAIT_SOURCE) / folder))
        if (entry.path().extension() == ".pd") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::string contents(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Gem is for those who have it.
bool has_gem() {
  Patch patch;
  patch.declare("-lib Gem");
  patch.object("gemhead");
  patch.quit_after(10);
  return run_pd(patch).errors().empty();
}

TEST(HelpPatches, open_without_an_error) {
  GAIT_NEEDS_PD();
  const bool gem = has_gem();
  for (const fs::path& file : patches()) {
    if (!gem && contents(file).find("-lib Gem") != std::string::npos) continue;
    Patch patch;
    const int begin = patch.object("loadbang");
    // With the model there at once, whatever the patch's boxes are made in the background.
    patch.object("gait.model gait-demo -blocking");
    patch.connect(begin, 0,
                  patch.message("; pd open " + file.filename().string() + " " GAIT_PD_FOLDER "/" +
                                fs::relative(file.parent_path(), GAIT_SOURCE).string()));
    patch.quit_after(2000);
    const PdRun run = run_pd(patch);
    EXPECT_EQ(run.exit_code, 0) << file << run.log;
    EXPECT_EQ(run.errors(), std::vector<std::string>()) << file << run.log;
  }
}

TEST(HelpPatches, are_there_for_every_object) {
  std::ifstream objects(GAIT_SOURCE "/externals/objects.txt");
  std::string line;
  int count = 0;
  for (; std::getline(objects, line); ++count) {
    const fs::path help = fs::path(GAIT_SOURCE) / "help_patches" /
                          (line.substr(0, line.find_first_of(" \t")) + "-help.pd");
    EXPECT_TRUE(fs::exists(help)) << help;
  }
  EXPECT_GE(count, 10);
  EXPECT_TRUE(fs::exists(GAIT_SOURCE "/help_patches/gait-help.pd"));
}

TEST(HelpPatches, have_no_boxes_that_overlap_or_lie_outside) {
  for (const fs::path& file : patches())
    for (const PatchWindow& window : read_patch(file))
      EXPECT_EQ(flaws(window), std::vector<std::string>()) << file;
}

TEST(HelpPatches, work_wherever_the_folder_lies) {
  for (const fs::path& file : patches()) {
    const std::string text = contents(file);
    const std::string up = file.parent_path().filename() == "parts" ? "../.." : "..";
    const bool declared =
        text.find(" 12;\n#X declare -path " + up + " -lib gait;\n") != std::string::npos;
    EXPECT_TRUE(declared) << file;
    for (const char* absolute : {"/home/", "/tmp/", "/usr/", "/Users/", "C:/"})
      EXPECT_EQ(text.find(absolute), std::string::npos) << file << ": " << absolute;
  }
}

TEST(HelpPatches, make_no_sound_before_they_are_asked) {
  for (const fs::path& file : patches())
    EXPECT_EQ(contents(file).find("pd dsp 1"), std::string::npos) << file;
}

TEST(PatchFile, sees_boxes_that_overlap) {
  const fs::path file = fs::path(::testing::TempDir()) / "gait_overlap.pd";
  std::ofstream(file)
      << "#N canvas 0 0 200 100 12;\n#X obj 10 10 cnv 15 100 40 empty empty empty 0 "
         "0 0 12 #fff #000 0;\n#X text 10 10 two lines of text, f 10;\n"
         "#X msg 60 30 there;\n#X obj 150 80 a.long.name;\n";
  EXPECT_EQ(flaws(read_patch(file).front()),
            std::vector<std::string>({"gait_overlap.pd: 'two lines of text' overlaps 'there'",
                                      "gait_overlap.pd: 'a.long.name' lies outside"}));
}

}  // namespace
}  // namespace gait::testing
