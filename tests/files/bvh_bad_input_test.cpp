#include <gtest/gtest.h>

#include <random>

#include "files/small_bvh.h"
#include "gait/error.h"
#include "gait/files/bvh.h"

namespace gait {
namespace {

using testing::replaced;
using testing::small_bvh;

std::string message_of(const std::string& text) {
  try {
    parse_bvh(text, "walk.bvh");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

struct Fault {
  const char* what;
  std::string text;
  std::vector<std::string> said;  // parts of the message
};

TEST(BvhBadInput, every_fault_is_named_with_file_line_and_what_was_expected) {
  const std::string small(small_bvh);
  const std::vector<Fault> faults{
      {"empty", "", {"walk.bvh:1:", "HIERARCHY", "empty"}},
      {"only white space", " \n\t\n", {"walk.bvh:3:", "HIERARCHY", "empty"}},
      {"not a BVH", "<html>\n", {"walk.bvh:1:", "'HIERARCHY'", "'<html>'"}},
      {"binary junk",
       std::string("\x7f\x45\x4c\x46\0\x01\xff", 7),
       {"walk.bvh:1:", "\\x7fELF\\x00"}},
      {"no root", "HIERARCHY\nMOTION\n", {"walk.bvh:2:", "'ROOT'", "'MOTION'"}},
      {"no name", replaced(small, "ROOT Hips", "ROOT"), {"walk.bvh:2:", "name"}},
      {"no brace",
       replaced(small, "Spine\n  {", "Spine\n"),
       {"walk.bvh:8:", "'{'", "'Spine'", "'OFFSET'"}},
      {"no offset",
       replaced(small, "    OFFSET 0.5 10 -0.25\n", ""),
       {"walk.bvh:13:", "OFFSET", "'Spine'"}},
      {"offset of two numbers",
       replaced(small, "0.5 10 -0.25", "0.5 10"),
       {"walk.bvh:9:", "number", "OFFSET", "'CHANNELS'"}},
      {"offset of four numbers",
       replaced(small, "0.5 10 -0.25", "0.5 10 1 2"),
       {"walk.bvh:8:", "'Spine'", "'2'"}},
      {"unknown channel",
       replaced(small, "Zrotation Xrotation Yrotation", "Zrotation Wrotation Yrotation"),
       {"walk.bvh:5:", "channel", "'Hips'", "'Wrotation'"}},
      {"fewer channels than said",
       replaced(small, "CHANNELS 3 X", "CHANNELS 4 X"),
       {"walk.bvh:10:", "channel", "'Spine'", "'End'"}},
      {"more channels than said",
       replaced(small, "CHANNELS 3 X", "CHANNELS 2 X"),
       {"walk.bvh:9:", "JOINT", "'Spine'", "'Zrotation'"}},
      {"a position twice",
       replaced(small, "Xposition Yposition", "Xposition Xposition"),
       {"walk.bvh:5:", "once", "'Hips'"}},
      {"absurd channels",
       replaced(small, "CHANNELS 6", "CHANNELS 600000000"),
       {"walk.bvh:5:", "number of channels", "0 to 32", "'600000000'"}},
      {"negative channels", replaced(small, "CHANNELS 6", "CHANNELS -6"), {"walk.bvh:5:", "'-6'"}},
      {"channels beyond counting",
       replaced(small, "CHANNELS 6", "CHANNELS 99999999999999999999999"),
       {"walk.bvh:5:"}},
      {"a word in a joint",
       replaced(small, "End Site", "Tail Site"),
       {"walk.bvh:10:", "End Site", "'Spine'", "'Tail'"}},
      {"ends in the hierarchy",
       small.substr(0, small.find("OFFSET 4")),
       {"walk.bvh:17:", "OFFSET", "'LeftUpLeg'", "end of the file"}},
      {"ends before the motion",
       small.substr(0, small.find("MOTION")),
       {"walk.bvh:26:", "'MOTION'", "end of the file"}},
      {"ends after MOTION",
       small.substr(0, small.find("Frames")),
       {"walk.bvh:27:", "'Frames:'", "end of the file"}},
      {"no frame time",
       replaced(small, "Frame Time: 0.0333333\n", ""),
       {"walk.bvh:28:", "'Frame Time:'", "'1'"}},
      {"frame time of zero", replaced(small, "0.0333333", "0"), {"walk.bvh:28:", "frame time"}},
      {"negative frame time",
       replaced(small, "0.0333333", "-0.03"),
       {"walk.bvh:28:", "frame time"}},
      {"frame time NaN", replaced(small, "0.0333333", "nan"), {"walk.bvh:28:", "finite", "'nan'"}},
      {"frame time and more",
       replaced(small, "0.0333333", "0.0333333 7"),
       {"walk.bvh:28:", "end of the line", "'7'"}},
      {"frames not a number",
       replaced(small, "Frames: 3", "Frames: three"),
       {"walk.bvh:27:", "number of frames", "'three'"}},
      {"negative frames", replaced(small, "Frames: 3", "Frames: -3"), {"walk.bvh:27:", "'-3'"}},
      {"frames and a half", replaced(small, "Frames: 3", "Frames: 2.5"), {"walk.bvh:27:", "'2.5'"}},
      {"absurd frames",
       replaced(small, "Frames: 3", "Frames: 4000000000"),
       {"walk.bvh:27:", "'4000000000'"}},
      {"no row", small.substr(0, small.find("1 90 2")), {"walk.bvh:29:", "3 rows", "none"}},
      {"cut in the first row",
       small.substr(0, small.find("10 20 30")),
       {"walk.bvh:29:", "3 rows", "none that is whole"}},
      {"a value too many",
       replaced(small, "-4 -5 -6\n", "-4 -5 -6 0\n"),
       {"walk.bvh:30:", "12 values", "frame 2", "more"}},
      {"a value too few",
       replaced(small, "-4 -5 -6\n", "-4 -5\n"),
       {"walk.bvh:30:", "12 values", "found 11"}},
      {"a row in two lines",
       replaced(small, "91 2.25", "91\n2.25"),
       {"walk.bvh:30:", "12 values", "found 2"}},
      {"NaN", replaced(small, "91", "NaN"), {"walk.bvh:30:", "finite", "'NaN'"}},
      {"Inf", replaced(small, "91", "-inf"), {"walk.bvh:30:", "finite", "'-inf'"}},
      {"NaN of another system",
       replaced(small, "91", "-1.#IND"),
       {"walk.bvh:30:", "number", "'-1.#IND'"}},
      {"a number too large", replaced(small, "91", "1e999"), {"walk.bvh:30:", "finite", "'1e999'"}},
      {"an absurd number", replaced(small, "91", "1e30"), {"walk.bvh:30:", "below 1e9", "'1e30'"}},
      {"a decimal comma", replaced(small, "2.25", "2,25"), {"walk.bvh:30:", "number", "'2,25'"}},
      {"a word in a row", replaced(small, "91", "ninety"), {"walk.bvh:30:", "number", "'ninety'"}},
      {"words after the rows", small + "the end\n", {"walk.bvh:32:", "number", "'the'"}},
  };
  for (const Fault& fault : faults) {
    const std::string message = message_of(fault.text);
    EXPECT_NE(message.find("expected"), std::string::npos) << fault.what << ": " << message;
    for (const std::string& part : fault.said)
      EXPECT_NE(message.find(part), std::string::npos)
          << fault.what << ": '" << part << "' is not in: " << message;
  }
}

TEST(BvhBadInput, joints_nested_too_deep_are_an_error_not_a_crash) {
  std::string text = "HIERARCHY\nROOT J\n{\nOFFSET 0 0 0\n";
  for (int depth = 0; depth < 100000; ++depth) text += "JOINT J\n{\nOFFSET 0 0 0\n";
  EXPECT_NE(message_of(text).find("nested at most"), std::string::npos) << message_of(text);
}

TEST(BvhBadInput, too_many_joints_are_an_error) {
  std::string text = "HIERARCHY\nROOT J\n{\nOFFSET 0 0 0\n";
  for (int joint = 0; joint < 20000; ++joint) text += "JOINT J { OFFSET 0 0 0 }\n";
  EXPECT_NE(message_of(text).find("at most 10000 joints"), std::string::npos) << message_of(text);
}

TEST(BvhBadInput, a_missing_file_or_a_folder_is_named) {
  const testing::TemporaryFolder folder;
  for (const auto& path : {folder / "missing.bvh", folder / "."}) try {
      read_bvh(path);
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
    }
}

// Bytes flipped, deleted, inserted, doubled: what comes out is a file or an Error, and a file that
// reads can be written and read again.
TEST(BvhBadInput, damaged_files_give_errors_and_never_crash) {
  std::mt19937 random(20);
  const auto below = [&](std::size_t limit) { return random() % limit; };
  const std::string interesting = "{}:.-+eE\n\r\t 0919\xff\x7fnNiIxX";
  int read = 0, refused = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text(small_bvh);
    for (std::size_t change = 0, changes = 1 + below(3); change < changes; ++change) {
      const std::size_t at = below(text.size());
      switch (below(7)) {
        case 0:
          text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text.erase(at, 1 + below(below(4) == 0 ? 60 : 2));
          break;
        case 2:
          text.insert(at, 1, interesting[below(interesting.size())]);
          break;
        case 3:
          text[at] = interesting[below(interesting.size())];
          break;
        case 4:
        case 5:
          if (const std::size_t digit = text.find_first_of("0123456789", at);
              digit != std::string::npos)
            text[digit] = static_cast<char>('0' + below(10));
          break;
        default:
          text.insert(at, text.substr(below(text.size()), below(40)));
          break;
      }
      if (text.empty()) text = " ";
    }
    try {
      const BvhFile file = parse_bvh(text, "damaged");
      ++read;
      const Clip clip = clip_from_bvh(file);
      for (const Eigen::Quaterniond& rotation : clip.rotations)
        ASSERT_NEAR(rotation.norm(), 1, 1e-9) << text;
      const BvhFile again = parse_bvh(bvh_text(file), "again");
      ASSERT_EQ(again.values, file.values) << text;
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(read, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace gait
