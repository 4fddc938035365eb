// Pictures and films as the program makes them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stack>

#include "sample_clips.h"
#include "shared_data.h"
#include "tool_runner.h"

namespace gait::testing {
namespace {

// Colours of left and right limbs and of the compared figure, as SVG writes them.
const std::string left = "rgb(5%,25%,55%)", right = "rgb(95%,52%,10%)",
                  compared = "rgb(74%,74%,76%)", middle = "rgb(30%,30%,33%)";

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

// Checksum of PNG chunks (ISO 3309).
std::uint32_t checksum(const std::string& bytes, std::size_t begin, std::size_t count) {
  std::uint32_t remainder = 0xFFFFFFFFu;
  for (std::size_t i = begin; i < begin + count; ++i) {
    remainder ^= static_cast<unsigned char>(bytes.at(i));
    for (int bit = 0; bit < 8; ++bit)
      remainder = remainder & 1u ? remainder >> 1 ^ 0xEDB88320u : remainder >> 1;
  }
  return ~remainder;
}

struct Size {
  std::uint32_t width = 0, height = 0;
};

// Walks through all chunks of a PNG file.
Size expect_png(const std::string& path) {
  const std::string bytes = bytes_of(path);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  std::size_t at = 8;
  std::string kind;
  bool pixels = false;
  while (at + 12 <= bytes.size()) {
    const std::size_t length = big_endian(bytes, at);
    kind = bytes.substr(at + 4, 4);
    pixels = pixels || kind == "IDAT";
    if (at + 12 + length > bytes.size()) break;
    EXPECT_EQ(big_endian(bytes, at + 8 + length), checksum(bytes, at + 4, 4 + length)) << kind;
    at += 12 + length;
  }
  EXPECT_EQ(at, bytes.size());
  EXPECT_EQ(kind, "IEND");
  EXPECT_TRUE(pixels);
  return {big_endian(bytes, 16), big_endian(bytes, 20)};
}

// Every tag that opens closes, in order.
void expect_well_formed(const std::string& svg) {
  std::stack<std::string> open;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const std::size_t end = svg.find('>', at);
    ASSERT_NE(end, std::string::npos) << "a tag never ends";
    const bool closes = svg[at + 1] == '/', alone = svg[end - 1] == '/' || svg[end - 1] == '?';
    const std::size_t name = at + (closes ? 2 : 1);
    const std::string tag = svg.substr(name, svg.find_first_of(" \t\n/>", name) - name);
    if (closes) {
      ASSERT_FALSE(open.empty()) << "closes too much: " << tag;
      ASSERT_EQ(open.top(), tag);
      open.pop();
    } else if (!alone) {
      open.push(tag);
    }
  }
  EXPECT_TRUE(open.empty());
}

std::string render_svg(const TestFolder& folder, std::vector<std::string> arguments) {
  const std::string path = folder / "picture.svg";
  arguments.insert(arguments.begin(), "render");
  arguments.insert(arguments.end(), {"-o", path});
  const ToolRun run = run_tool(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  std::string svg = bytes_of(path);
  expect_well_formed(svg);
  // Versions of Cairo differ in the spaces inside a colour.
  for (std::size_t at; (at = svg.find("%, ")) != std::string::npos;) svg.erase(at + 2, 1);
  return svg;
}

// Lines (not areas) drawn in a colour.
int strokes(const std::string& svg, const std::string& colour) {
  int count = 0;
  for (const std::string before : {"stroke:", "stroke=\""})
    for (std::size_t at = svg.find(before + colour); at != std::string::npos;
         at = svg.find(before + colour, at + 1))
      ++count;
  return count;
}

// A straight line of the picture, pixels.
struct Line {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// All straight lines in a colour; in any colour when none is given.
std::vector<Line> lines(const std::string& svg, const std::string& colour = "") {
  std::vector<Line> found;
  for (std::size_t at = svg.find("<path", svg.find("</defs>")); at != std::string::npos;
       at = svg.find("<path", at + 1)) {
    const std::string path = svg.substr(at, svg.find('>', at) - at);
    const std::size_t data = path.find(" d=\"M ");
    Line line;
    if (path.find(colour) != std::string::npos && data != std::string::npos &&
        std::sscanf(path.c_str() + data, " d=\"M %lf %lf L %lf %lf", &line.x0, &line.y0, &line.x1,
                    &line.y1) == 4)
      found.push_back(line);
  }
  return found;
}

// The legend has one line of each colour; the rest is limbs.
int limbs(const std::string& svg, const std::string& colour) { return strokes(svg, colour) - 1; }

TEST(Render, a_picture_is_a_png_file_of_a_size_that_fits_a_page) {
  const TestFolder folder;
  write_walk(folder / "walk.bvh");
  const ToolRun run = run_tool({"render", folder / "walk.bvh", "-o", folder / "walk.PNG"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out, "");
  const Size one = expect_png(folder / "walk.PNG");
  EXPECT_GT(one.width, one.height);
  EXPECT_LE(one.width, 1800u);

  ASSERT_EQ(run_tool({"render", folder / "walk.bvh", folder / "walk.bvh", folder / "walk.bvh", "-o",
                      folder / "rows.png"})
                .exit_code,
            0);
  EXPECT_GT(expect_png(folder / "rows.png").height, 2 * one.height);
}

TEST(Render, the_same_clip_gives_the_same_bytes) {
  const TestFolder folder;
  write_walk(folder / "walk.bvh");
  for (const std::string ending : {".png", ".svg"}) {
    for (const std::string name : {"a", "b"})
      ASSERT_EQ(run_tool({"render", folder / "walk.bvh", "-o", folder / name + ending}).exit_code,
                0);
    EXPECT_EQ(bytes_of(folder / "a" + ending), bytes_of(folder / "b" + ending));
  }
}

TEST(Render, strobe_says_how_many_figures_there_are) {
  const TestFolder folder;
  write_walk(folder / "walk.bvh");
  const int one = limbs(render_svg(folder, {folder / "walk.bvh", "--strobe", "1"}), left);
  EXPECT_GT(one, 0);
  EXPECT_EQ(limbs(render_svg(folder, {folder / "walk.bvh", "--strobe", "3"}), left), 3 * one);
  EXPECT_EQ(limbs(render_svg(folder, {folder / "walk.bvh", "--strobe", "7"}), left), 7 * one);
}

TEST(Render, left_and_right_are_drawn_alike_in_two_colours) {
  const TestFolder folder;
  write_walk(folder / "walk.bvh");
  const std::string svg = render_svg(folder, {folder / "walk.bvh"});
  EXPECT_GT(limbs(svg, left), 20);
  EXPECT_EQ(limbs(svg, left), limbs(svg, right));
}

TEST(Render, every_figure_stays_on_the_page_from_every_side) {
  const TestFolder folder;
  write_walk(folder / "walk.bvh", "drunk");
  for (const std::string view : {"side", "front", "45", "-90", "180"}) {
    const std::string svg = render_svg(folder, {folder / "walk.bvh", "--view", view});
    double width = 0, height = 0;
    ASSERT_EQ(
        std::sscanf(svg.c_str() + svg.find("viewBox"), "viewBox=\"0 0 %lf %lf\"", &width, &height),
        2);
    EXPECT_GT(lines(svg).size(), 50u) << view;
    for (const Line& line : lines(svg)) {
      EXPECT_GE(std::min(line.x0, line.x1), 0) << view;
      EXPECT_LE(std::max(line.x0, line.x1), width) << view;
      EXPECT_GE(std::min(line.y0, line.y1), 0) << view;
      EXPECT_LE(std::max(line.y0, line.y1), height) << view;
    }
  }
}

TEST(Render, a_compared_clip_is_drawn_in_grey_once_behind_each_figure) {
  const TestFolder folder;
  write_walk(folder / "walk.bvh", "proud");
  write_walk(folder / "other.bvh", "sad");
  const std::string alone = render_svg(folder, {folder / "walk.bvh", "--strobe", "5"});
  const std::string both =
      render_svg(folder, {folder / "walk.bvh", "--compare", folder / "other.bvh", "--strobe", "5"});
  EXPECT_EQ(strokes(alone, compared), 0);
  // The same skeleton: as many grey lines as coloured ones, so more than left and right together.
  EXPECT_GT(limbs(both, compared), limbs(both, left) + limbs(both, right));
  EXPECT_EQ(limbs(both, compared) % 5, 0);
  EXPECT_EQ(limbs(both, left), limbs(alone, left));
}

TEST(Render, what_is_no_body_is_drawn_without_sides) {
  const TestFolder folder;
  write_file(folder / "crane.bvh", arm_of_a_crane(40));
  const std::string svg = render_svg(folder, {folder / "crane.bvh", "--unit", "cm", "--up", "y"});
  EXPECT_EQ(strokes(svg, left), 0);
  EXPECT_EQ(strokes(svg, right), 0);
  EXPECT_EQ(strokes(svg, middle), 12 * 3);
}

TEST(Render, one_frame_of_a_z_up_rig_in_inches_stands_upright) {
  const TestFolder folder;
  write_file(folder / "pose.bvh", t_pose_z_up());
  const std::string svg = render_svg(folder, {folder / "pose.bvh", "--view", "front"});
  EXPECT_EQ(limbs(svg, left), 6);  // thigh, shank, foot, upper arm, forearm, hand
  // The longest left lines are the leg's, and they are upright.
  int upright = 0;
  for (const Line& line : lines(svg, left))
    if (std::abs(line.y1 - line.y0) > 50 && std::abs(line.x1 - line.x0) < 1) ++upright;
  EXPECT_EQ(upright, 2);
}

TEST(Render, every_file_of_the_zoo_is_drawn) {
  GAIT_NEEDS_SHARED_DATA("bvh-zoo");
  const TestFolder folder;
  int drawn = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(shared_data() / "bvh-zoo")) {
    if (entry.path().extension() != ".bvh") continue;
    const ToolRun run = run_tool({"render", entry.path().string(), "-o", folder / "zoo.png"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    expect_png(folder / "zoo.png");
    ++drawn;
  }
  EXPECT_GT(drawn, 10);
}

TEST(Render, a_film_is_made_where_ffmpeg_is) {
  if (!ffmpeg_is_there()) GTEST_SKIP() << "no ffmpeg here: no film to test";
  const TestFolder folder;
  write_walk(folder / "walk.bvh", "in-a-hurry", 1);
  const ToolRun run = run_tool({"render", folder / "walk.bvh", "-o", folder / "walk.mp4"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "") << "progress belongs on a terminal";
  const std::string film = bytes_of(folder / "walk.mp4");
  EXPECT_EQ(film.substr(4, 4), "ftyp");
  EXPECT_GT(film.size(), 5000u);
}

TEST(Render, a_film_without_ffmpeg_is_an_error_that_says_so) {
  const TestFolder folder;
  write_walk(folder / "walk.bvh", "proud", 1);
  const ToolRun run =
      run_tool({"render", folder / "walk.bvh", "-o", folder / "walk.mp4"}, folder.path());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("ffmpeg"), std::string::npos) << run.err;
  EXPECT_EQ(lines_of(run.err), 1);
}

TEST(Render, a_failing_ffmpeg_is_quoted_and_leaves_no_film) {
  const TestFolder folder;
  write_walk(folder / "walk.bvh", "proud", 1);
  const std::string fake = folder / "ffmpeg";
  write_file(fake, "#!/bin/sh\necho 'first word' >&2\necho 'no room for films' >&2\nexit 3\n");
  std::filesystem::permissions(fake, std::filesystem::perms::owner_all);
  const ToolRun run =
      run_tool({"render", folder / "walk.bvh", "-o", folder / "walk.mp4"}, folder.path());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("no room for films"), std::string::npos) << run.err;
  EXPECT_EQ(lines_of(run.err), 1);
  EXPECT_FALSE(std::filesystem::exists(folder / "walk.mp4"));
  EXPECT_FALSE(std::filesystem::exists(folder / "walk.mp4.part"));
}

}  // namespace
}  // namespace gait::testing
