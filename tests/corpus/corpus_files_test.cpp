#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "gait/corpus/corpus.h"
#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/files/label_file.h"
#include "gait/motion/rotation.h"

namespace gait {
namespace {

TEST(CorpusFiles, walks_written_and_read_again_are_the_same) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "gait_corpus_files_test";
  std::filesystem::remove_all(folder);
  std::vector<CorpusWalk> walks;
  for (const char* style : {"cat-walk", "in-a-hurry"}) {
    WalkPlan plan{.style = corpus_style(style)};
    plan.cycles = 2;
    plan.take = 3;
    walks.push_back(make_walk(plan));
  }
  const auto paths = write_corpus(folder, walks, 0.01);
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths[0].filename(), "walk_cat-walk_3.bvh");
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Clip clip = clip_from_bvh(read_bvh(paths[i]));
    ASSERT_EQ(clip.frames(), walks[i].clip.frames());
    EXPECT_NEAR(clip.frame_rate, 30, 1e-3);
    for (int frame = 0; frame < clip.frames(); ++frame) {
      EXPECT_LT((clip.translation(frame)[0] - 100 * walks[i].clip.translation(frame)[0]).norm(),
                1e-6);
      for (std::size_t joint = 0; joint < clip.pose(frame).size(); ++joint)
        EXPECT_LT(angle_between(clip.pose(frame)[joint], walks[i].clip.pose(frame)[joint]), 1e-6);
    }
    for (std::size_t joint = 0; joint < clip.skeleton.joints.size(); ++joint)
      EXPECT_EQ(clip.skeleton.joints[joint].tips.size(),
                walks[i].clip.skeleton.joints[joint].tips.size());
    auto labels = paths[i];
    const LabelFile file = read_labels(labels.replace_extension(".txt"));
    EXPECT_EQ(contacts_from_labels(file.segments, 30), walks[i].contacts);
  }
  std::filesystem::remove_all(folder);
}

TEST(CorpusFiles, a_folder_that_cannot_be_made_is_an_error_that_names_it) {
  try {
    write_corpus("/dev/null/walks", {});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("/dev/null/walks"), std::string::npos);
  }
}

}  // namespace
}  // namespace gait
