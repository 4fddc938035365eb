// What comes out when an upper body is far from all that was taught: never worse than standing
// still.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "gait/corpus/corpus.h"
#include "gait/corpus/demo_model.h"
#include "gait/judge/evaluation.h"
#include "gait/motion/rotation.h"

namespace gait {
namespace {

// Walks whose measured joints are turned by so many radians, each about an axis of its own: as a
// suit that was put on, or calibrated, otherwise.
std::vector<Walk> turned_walks(const Model& model, double turn, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Walk> walks;
  for (const CorpusWalk& made : make_corpus(2)) {
    if (made.take != 1 || (made.style != "decided" && made.style != "sad")) continue;
    Walk walk{made.clip, {}, {}, {}, made.contacts};
    for (const int joint : model.body->input_joints) {
      const Eigen::Vector3d axis(normal(random), normal(random), normal(random));
      const Eigen::Quaterniond by = exponential_map<double>(turn * axis.normalized());
      for (int frame = 0; frame < walk.clip.frames(); ++frame)
        walk.clip.pose(frame)[joint] = walk.clip.pose(frame)[joint] * by;
    }
    walks.push_back(std::move(walk));
  }
  return walks;
}

TEST(FarFromTaught, legs_are_never_much_worse_than_the_mean_pose_nor_do_they_shake) {
  const auto model = std::make_shared<const Model>(make_demo_model());
  for (const double turn : {0.0, 0.1, 0.3, 0.6, 1.2, 2.5})
    for (const unsigned seed : {1u, 2u}) {
      const Evaluation judged = evaluate(model, turned_walks(*model, turn, seed), {});
      const double mean = judged.error(Estimate::mean_pose).over_clips;
      const double found = judged.error(Estimate::synthesised).over_clips;
      SCOPED_TRACE(turn);
      EXPECT_LT(found, mean + std::numbers::pi / 180);
      EXPECT_LT(judged.jerk(Source::synthesised).over_clips,
                2 * judged.jerk(Source::truth).over_clips);
      if (turn <= 0.1) {
        EXPECT_LT(found, 0.6 * mean);
      }
    }
}

}  // namespace
}  // namespace gait
