// [gait.figure] and [gait.panel]: what they draw, and that nothing drawn is kept.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "patches/patch.h"
#include "patches/screen.h"

namespace gait::testing {
namespace {

constexpr std::array<int, 3> red{255, 0, 0}, bar{0x2b, 0x5f, 0x6b}, green{0x3f, 0xa3, 0x4d};

#define GAIT_NEEDS_A_SCREEN() \
  if (!has_screen()) GTEST_SKIP() << "there is no Xvfb, or no Pd with a window, here"

// Someone of five joints: hips, head, a hand that moves, two feet.
const char* const bones = "bones 0 1 1 2 0 3 0 4";
std::string places(double hand) {
  return "pos 0 0.9 0 0 1.6 0 0.6 " + std::to_string(hand) + " 0 0.2 0 0 -0.2 0 0";
}

// A patch in which a message comes ten times a second.
void again_and_again(Patch& patch, const std::string& message, int to) {
  const int begin = patch.object("loadbang"), metro = patch.object("metro 100"),
            box = patch.message(message);
  patch.connect(begin, 0, metro);
  patch.connect(metro, 0, box);
  patch.connect(box, 0, to);
}

TEST(Figure, is_drawn_in_its_colour_and_size) {
  GAIT_NEEDS_A_SCREEN();
  // Red, by its message or its argument; seen from the front, where the hand stretches out.
  int dots_of[2];
  for (const bool large : {false, true}) {
    Patch patch;
    const int figure = patch.object(large ? "gait.figure 0 60 side" : "gait.figure 900 100 front");
    if (large) patch.at_start({"colour 900", "view 90", "size 200"}, figure);
    patch.at_start({bones}, figure);
    again_and_again(patch, places(1.2), figure);
    const Screen screen(patch);
    dots_of[large] = screen.wait_for_dots(red, large ? 3 * dots_of[0] + 1 : 701);
    EXPECT_EQ(screen.log().find("error"), std::string::npos) << screen.log();
  }
  // Bones: 0.7 + 0.72 + 2 * 0.92 m at 100 dots a metre, 3 wide, and the head.
  EXPECT_GT(dots_of[0], 700);
  EXPECT_LT(dots_of[0], 2000);
  EXPECT_GT(dots_of[1], 3 * dots_of[0]);  // twice as long and twice as wide
}

TEST(Figure, leaves_nobody_drawn_without_bones_and_makes_no_errors_in_the_dark) {
  GAIT_NEEDS_PD();
  Patch patch;
  const int figure = patch.object("gait.figure 900 100 front");
  // Places without bones, bones without places, more and fewer of both, and settings.
  patch.at_start({places(1), bones, places(1), "bones 0 1", "pos 0 0 0 1 1 1", "bones", "pos",
                  "trail 3", bones, places(0.5), "trail 0", "follow 0", "follow 1", "view side",
                  "view 30", "fps 10", "size 40", "colour 9"},
                 figure);
  patch.quit_after(500);
  const PdRun run = run_pd(patch);
  EXPECT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
}

TEST(Panel, shows_styles_as_bars_and_a_stream_as_a_light) {
  GAIT_NEEDS_A_SCREEN();
  Patch patch;
  const int panel = patch.object("gait.panel");
  patch.at_start({"stream 1"}, panel);
  again_and_again(patch, "styles 0.2 0.8 0 0 0 0 0 0 0 0 0", panel);
  const Screen screen(patch);
  EXPECT_GE(screen.wait_for_dots(bar, 1700), 1700);  // 150 dots wide in all, 12 high
  EXPECT_LT(screen.dots(bar), 2100);
  EXPECT_GE(screen.wait_for_dots(green, 250), 250);  // 18 by 18, less its frame
}

TEST(Panel, asks_for_the_cost_of_frames_and_stands_still_when_frozen) {
  GAIT_NEEDS_PD();
  Patch patch;
  const int panel = patch.object("gait.panel gait-demo");
  patch.object("gait.model gait-demo -blocking");
  patch.record(panel, 0, "asked");
  patch.at_start({"stream 0", "phase 0.1", "styles 0.5 0.5", "style sad 0.5", "latency 33.3",
                  "perf 20 30 100 1", "unlike 3", "freeze 1", "styles 1 0", "freeze 0"},
                 panel);
  patch.quit_after(3500);
  const PdRun run = run_pd(patch);
  EXPECT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  EXPECT_EQ(run.recorded("asked").size(), 4u);
}

TEST(Abstractions, keep_nothing_that_was_drawn) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(GAIT_SOURCE "/abstractions")) {
    std::ifstream in(entry.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(text.find("#X scalar"), std::string::npos) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 2);
}

}  // namespace
}  // namespace gait::testing
