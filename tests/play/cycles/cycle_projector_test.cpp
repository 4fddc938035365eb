// What the style walker walks, projected again: the scores it was told.
#include "gait/play/cycles/cycle_projector.h"

#include <gtest/gtest.h>

#include "gait/model/body_pose.h"
#include "gait/play/cycles/style_walker.h"
#include "play/cycles/styled_walks.h"

namespace gait {
namespace {

using testing::corpus_walks;

std::vector<float> vectors_of(std::span<const Eigen::Quaternionf> pose, const Body& body) {
  std::vector<Eigen::Quaternionf> references;
  std::vector<int> joints;
  for (const auto& reference : body.references) {
    joints.push_back(static_cast<int>(joints.size()));
    references.push_back(reference.cast<float>());
  }
  std::vector<float> values(3 * joints.size());
  pose_vector<float>(pose, references, joints, values);
  return values;
}

TEST(CycleProjector, finds_the_scores_of_a_synthesised_walk_again) {
  const auto& model = corpus_walks().model;
  StyleWalker walker(model, 3);
  walker.set_style(testing::style_named(*model, "sad"));
  walker.set_variation(0);  // every cycle the mean one: no joins in it
  CycleProjector projector(model, model->style_space->space);
  const Eigen::VectorXf deviations =
      model->style_space->space.variances.head(walker.components()).cwiseSqrt().cast<float>();
  int projected = 0;
  for (int frame = 0; frame < 2000; ++frame) {
    walker.advance(0.005);
    ASSERT_TRUE(projector.add(vectors_of(walker.pose(), *model->body)));
    if (!walker.contact() || !projector.contact(*walker.contact())) continue;
    ++projected;
    // The first few carry what is to be seen; an error of 0.1 rad in a whole cycle is small.
    for (int i = 0; i < 5; ++i)
      EXPECT_NEAR(projector.scores()[static_cast<std::size_t>(i)] * deviations[i],
                  walker.scores()[i], 0.03 * deviations[0])
          << i;
  }
  EXPECT_GE(projected, 4);
}

TEST(CycleProjector, takes_neither_other_sizes_nor_cycles_that_are_none) {
  const auto& model = corpus_walks().model;
  CycleProjector projector(model, model->style_space->space);
  const std::vector<float> pose(3 * model->body->skeleton.joints.size(), 0.1f);
  EXPECT_FALSE(projector.add(std::span(pose).first(5)));
  EXPECT_FALSE(projector.contact(Foot::right));  // no frame yet
  const auto frames = [&](int count) {
    for (int i = 0; i < count; ++i) EXPECT_TRUE(projector.add(pose));
  };
  frames(30);
  EXPECT_FALSE(projector.contact(Foot::right));  // began somewhere
  frames(2);
  EXPECT_FALSE(projector.contact(Foot::right));  // a switch that bounces
  frames(CycleProjector::most_frames + 5);
  EXPECT_FALSE(projector.contact(Foot::right));  // stood for long
  frames(30);
  EXPECT_TRUE(projector.contact(Foot::right));
  projector.reset();
  frames(30);
  EXPECT_FALSE(projector.contact(Foot::right));
}

}  // namespace
}  // namespace gait
