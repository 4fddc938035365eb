// Walks recorded as poses in a patch: steps are found in them and learnt, styles too.
#include "gait/teach/walk_takes.h"

#include <gtest/gtest.h>

#include "gait/corpus/demo_model.h"
#include "gait/error.h"
#include "gait/model/body_pose.h"
#include "gait/play/cycles/style_walker.h"

namespace gait {
namespace {

std::shared_ptr<const Model> demo() {
  static const auto model = std::make_shared<const Model>(make_demo_model());
  return model;
}

// What a patch records of a walker: poses at moments that are not quite even.
RecordedTake walked(const std::string& style, double seconds, std::uint64_t seed) {
  StyleWalker walker(demo(), seed);
  const auto at = std::ranges::find(demo()->styles, style) - demo()->styles.begin();
  walker.set_style(static_cast<int>(at));
  std::vector<Eigen::Quaternionf> references;
  std::vector<int> joints;
  for (const auto& reference : demo()->body->references) {
    joints.push_back(static_cast<int>(joints.size()));
    references.push_back(reference.cast<float>());
  }
  RecordedTake take{style, static_cast<int>(3 * joints.size()), 0, {}, {}};
  std::vector<float> values(3 * joints.size());
  double time = 0;
  for (int frame = 0; frame < seconds * 60; ++frame) {
    const double step = (frame % 3 == 0 ? 0.8 : 1.1) / 60;
    walker.advance(step);
    pose_vector<float>(walker.pose(), references, joints, values);
    take.seconds.push_back(time);
    time += step;
    take.values.insert(take.values.end(), values.begin(), values.end());
  }
  return take;
}

TEST(WalkTakes, teach_steps_and_styles) {
  std::vector<RecordedTake> takes;
  for (const char* style : {"proud", "sad", "in-a-hurry"})
    for (std::uint64_t take = 1; take <= 2; ++take) takes.push_back(walked(style, 12, take));
  const TakesLearnt learnt = learn_walk_takes(takes, *demo()->body, "mine");
  EXPECT_EQ(learnt.model.styles.size(), 3u);
  EXPECT_EQ(learnt.model.labels.size(), 2u);
  EXPECT_TRUE(learnt.model.style_space.has_value());
  EXPECT_EQ(learnt.model.input.values, demo()->input.values);
  EXPECT_EQ(learnt.model.output.values, demo()->output.values);
  EXPECT_GE(learnt.judged.accuracy, 0.95);
  EXPECT_GE(learnt.model.training.validated_style_accuracy, 0.95);
  EXPECT_LT(learnt.judged.error, 0.07);  // 4 degrees
}

TEST(WalkTakes, of_another_body_are_named) {
  RecordedTake take{"sad", 6, 0, {0, 1}, std::vector<float>(12, 0.0f)};
  try {
    learn_walk_takes({take}, *demo()->body, "mine");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find("take 0 ('sad'): expected 54 values per pose"), 0u)
        << error.what();
  }
}

}  // namespace
}  // namespace gait
