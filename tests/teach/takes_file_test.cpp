// Takes on disk: read as they were written, also when the last one was cut off by a crash.
#include "gait/teach/takes_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "gait/error.h"

namespace gait {
namespace {

RecordedTake take_of(const std::string& label, int frames) {
  RecordedTake take{label, 2, 1, {}, {}};
  for (int frame = 0; frame < frames; ++frame) {
    take.seconds.push_back(frame * 0.0101);
    for (int i = 0; i < 3; ++i) take.values.push_back(0.1f * static_cast<float>(frame + i));
  }
  return take;
}

std::string written(const std::vector<RecordedTake>& takes) {
  std::ostringstream text;
  write_takes_header(text);
  for (const RecordedTake& take : takes) write_take(take, text);
  return text.str();
}

std::string path_of(const std::string& text) {
  const std::string path = ::testing::TempDir() + "gait_takes.txt";
  std::ofstream(path) << text;
  return path;
}

TEST(TakesFile, reads_what_it_wrote) {
  const std::vector<RecordedTake> takes{take_of("circle", 20), take_of("a \"long\" name", 7)};
  const auto read = read_takes(path_of(written(takes)));
  ASSERT_EQ(read.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].label, takes[i].label);
    EXPECT_EQ(read[i].values, takes[i].values);
    EXPECT_EQ(read[i].inputs, 2);
    EXPECT_EQ(read[i].outputs, 1);
    for (int frame = 0; frame < takes[i].frames(); ++frame)
      EXPECT_NEAR(read[i].seconds[frame], takes[i].seconds[frame], 1e-8);
  }
}

TEST(TakesFile, keeps_all_whole_frames_of_a_take_that_was_cut_off) {
  const std::string text = written({take_of("a", 20), take_of("b", 20)});
  for (const std::size_t cut : {1u, 4u, 5u, 40u, 200u}) {
    const auto read = read_takes(path_of(text.substr(0, text.size() - cut)));
    ASSERT_EQ(read.size(), 2u) << cut;
    EXPECT_TRUE(read[0].finished);
    EXPECT_FALSE(read[1].finished);
    EXPECT_EQ(read[1].label, "b");
    EXPECT_GE(read[1].frames(), 20 - static_cast<int>(cut + 14) / 15 - 1) << cut;
    EXPECT_EQ(read[1].values.size(), 3u * read[1].seconds.size());
  }
  // A take that another session's end cut off stands before others.
  const std::string both = written({take_of("a", 20)});
  const auto read =
      read_takes(path_of(both.substr(0, both.size() - 4) + text.substr(text.find("take b"))));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_FALSE(read[0].finished);
  EXPECT_EQ(read[0].frames(), 20);
  EXPECT_TRUE(read[1].finished);
}

TEST(TakesFile, reads_files_of_version_1) {
  const std::string text = "gait takes 1\ntake a 2 1 1\n0 1 2\n0.1 1 2\ntake b 0 1 1\n";
  const auto read = read_takes(path_of(text + "take \"c d\" 2 1 1\n0 1 2\n0.1 1 2"));
  ASSERT_EQ(read.size(), 2u);  // the last was cut off
  EXPECT_EQ(read[0].frames(), 2);
  EXPECT_TRUE(read[0].finished);
  EXPECT_EQ(read[1].label, "b");
}

TEST(TakesFile, names_the_line_that_is_wrong) {
  const auto said = [](const std::string& text) -> std::string {
    try {
      read_takes(path_of(text));
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_NE(said("something").find(":1: expected 'gait takes 2'"), std::string::npos);
  EXPECT_NE(said("gait takes 1\nhello\n").find(":2: expected take LABEL"), std::string::npos);
  EXPECT_NE(said("gait takes 1\ntake a 2 x 1\n").find(":2: expected take LABEL FRAMES"),
            std::string::npos);
  EXPECT_NE(said("gait takes 2\ntake a 1 1\n0 1 2\n0 1 2\n").find(":4: expected seconds"),
            std::string::npos);
  EXPECT_NE(said("gait takes 1\ntake a 2 1 1\n0 1 nan\n1 1 2\n").find(":3: expected"),
            std::string::npos);
}

TEST(TakesFile, comes_to_a_frame_rate) {
  const Take take = at_rate(take_of("a", 100), 30);
  ASSERT_EQ(take.inputs.cols(), 30);
  for (int frame = 0; frame < 30; ++frame)  // values grow by 0.1 per 10.1 ms
    EXPECT_NEAR(take.inputs(1, frame), 0.1 * (frame / 30.0 / 0.0101 + 1), 1e-4);
  EXPECT_EQ(take.outputs.rows(), 1);
}

}  // namespace
}  // namespace gait
