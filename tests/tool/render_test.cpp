// Pictures and films as the program makes them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <regex>
#include <stack>

#include "sample_clips.h"
#include "shared_data.h"
#include "tool_runner.h"

namespace gait::testing {
namespace {

// Colours of left and right limbs and of the compared figure, as SVG writes them.
const std::string left = "5%, ?25%, ?55%", right = "95%, ?52%, ?10%", compared = "74%, ?74%, ?76%";

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
  const std::regex tag("<([?!/]?)([A-Za-z:]+)[^>]*?(/?)>");
  for (std::sregex_iterator it(svg.begin(), svg.end(), tag), end; it != end; ++it) {
    if ((*it)[1] == "?" || (*it)[1] == "!" || (*it)[3] == "/") continue;
    if ((*it)[1] != "/") {
      open.push((*it)[2]);
      continue;
    }
    ASSERT_FALSE(open.empty()) << "closes too much: " << it->str();
    ASSERT_EQ(open.top(), (*it)[2]);
    open.pop();
  }
  EXPECT_TRUE(open.empty());
}

std::string render_svg(const TestFolder& folder, std::vector<std::string> arguments) {
  const std::string path = folder / "picture.svg";
  arguments.insert(arguments.begin(), "render");
  arguments.insert(arguments.end(), {"-o", path});
  const ToolRun run = run_tool(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const std::string svg = bytes_of(path);
  expect_well_formed(svg);
  return svg;
}

// Lines (not areas) drawn in a colour.
int strokes(const std::string& svg, const std::string& colour) {
  const std::regex stroke("stroke(:|=\")rgb\\(" + colour + "\\)");
  return static_cast<int>(
      std::distance(std::sregex_iterator(svg.begin(), svg.end(), stroke), std::sregex_iterator()));
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
    std::smatch size;
    ASSERT_TRUE(std::regex_search(svg, size, std::regex("viewBox=\"0 0 ([0-9]+) ([0-9]+)\"")));
    const double width = std::stod(size[1]), height = std::stod(size[2]);
    const std::string body = svg.substr(svg.find("</defs>"));
    const std::regex line(" d=\"M ([-0-9.]+) ([-0-9.]+) L ([-0-9.]+) ([-0-9.]+)");
    int lines = 0;
    for (std::sregex_iterator it(body.begin(), body.end(), line), end; it != end; ++it, ++lines)
      for (const int corner : {1, 3}) {
        EXPECT_GE(std::stod((*it)[corner]), 0) << view;
        EXPECT_LE(std::stod((*it)[corner]), width) << view;
        EXPECT_GE(std::stod((*it)[corner + 1]), 0) << view;
        EXPECT_LE(std::stod((*it)[corner + 1]), height) << view;
      }
    EXPECT_GT(lines, 50) << view;
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
  EXPECT_EQ(strokes(svg, "30%, ?30%, ?33%"), 12 * 3);
}

TEST(Render, one_frame_of_a_z_up_rig_in_inches_stands_upright) {
  const TestFolder folder;
  write_file(folder / "pose.bvh", t_pose_z_up());
  const std::string svg = render_svg(folder, {folder / "pose.bvh", "--view", "front"});
  EXPECT_EQ(limbs(svg, left), 6);  // thigh, shank, foot, upper arm, forearm, hand
  // The longest left lines are the leg's, and they are upright.
  const std::regex line("rgb\\(" + left +
                        "\\)[^>]* d=\"M ([-0-9.]+) ([-0-9.]+) L ([-0-9.]+) "
                        "([-0-9.]+)");
  int upright = 0;
  for (std::sregex_iterator it(svg.begin(), svg.end(), line), end; it != end; ++it) {
    const double across = std::abs(std::stod((*it)[3]) - std::stod((*it)[1]));
    const double down = std::abs(std::stod((*it)[4]) - std::stod((*it)[2]));
    if (down > 50 && across < 1) ++upright;
  }
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
