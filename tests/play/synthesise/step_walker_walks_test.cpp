// What the step walker walks, judged as a captured walk would be: by the recogniser, by its joints
// and by its feet.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "gait/judge/foot_slide.h"
#include "gait/motion/contacts.h"
#include "gait/motion/kinematics.h"
#include "gait/play/stream_reconstructor.h"
#include "gait/play/synthesise/step_walker.h"
#include "play/body/bends.h"
#include "play/body/sole_height.h"
#include "play/change/joint_motion.h"
#include "play/cycles/styled_walks.h"

namespace gait {
namespace {

using testing::captured_walks;
using testing::corpus_walks;
using testing::JointMotion;
using testing::percentile;
using testing::StyledWalks;

constexpr double seconds = 20;

struct StepsWalked {
  Clip clip;
  std::vector<Contact> contacts;
  std::vector<testing::Pose> poses;
  int cycles = 0, recognised = 0;
};

// The style's posteriors over each whole cycle, but for the first two: whose is their mean?
StepsWalked walk_in_style(const StyledWalks& walks, int style) {
  const Model& model = *walks.model;
  const int frames = static_cast<int>(seconds * model.frame_rate);
  StepsWalked walked;
  StepWalker walker(walks.model);
  EXPECT_TRUE(walker.set_style(style));
  WalkRecorder recorder(*model.body, model.frame_rate);
  StreamReconstructor reconstructor(walks.model);
  Eigen::VectorXf posteriors = Eigen::VectorXf::Zero(walker.weights().size());
  int begun = 0;
  for (int frame = 0; frame < frames; ++frame) {
    walker.advance();
    recorder.add(walker.pose());
    if (walker.entered())
      walked.contacts.push_back({frame, *walker.entered() == 0 ? Foot::right : Foot::left});
    if (walker.entered() && *walker.entered() == 0) {
      Eigen::Index best = 0;
      posteriors.maxCoeff(&best);
      if (begun > 2) walked.recognised += best == style, ++walked.cycles;
      ++begun;
      posteriors.setZero();
    }
    if (!reconstructor.advance(walker.inputs())) continue;
    for (std::size_t s = 0; s < reconstructor.frame().styles.size(); ++s)
      posteriors[static_cast<Eigen::Index>(s)] += reconstructor.frame().styles[s];
  }
  walked.clip = recorder.clip("walked");
  for (int frame = 0; frame < frames; ++frame) {
    const auto pose = walked.clip.pose(frame);
    walked.poses.emplace_back(pose.begin(), pose.end());
  }
  return walked;
}

// Mean slide per stance of each style's captured walks, millimetres.
std::map<std::string, double> captured_slide(const StyledWalks& walks) {
  std::map<std::string, std::pair<double, int>> sums;
  for (const Walk& walk : walks.walks) {
    const JointRoles roles = find_roles(walk.clip.skeleton);
    const FootSlide slide =
        foot_slide(walk.clip, roles,
                   walk.contacts.empty() ? follow_walk(walk.clip, roles).contacts : walk.contacts);
    for (const double stance : slide.stances)
      sums[walk.style].first += stance, ++sums[walk.style].second;
  }
  std::map<std::string, double> means;
  for (const auto& [style, sum] : sums) means[style] = sum.first / sum.second;
  return means;
}

// `slide_limit`: of a style, mm per stance.
template <typename Limit>
void expect_like_training(const StyledWalks& walks, Limit slide_limit) {
  const Model& model = *walks.model;
  JointMotion training, joins;
  const WalkSequences sequences = walk_sequences(walks.walks, {});
  for (const Sequence& sequence : sequences.sequences) {
    const std::vector<testing::Pose> poses = testing::poses_of(sequence);
    training.add(poses, model.frame_rate, 0, poses.size());
  }
  for (std::size_t style = 0; style < model.styles.size(); ++style) {
    const std::string& name = model.styles[style];
    const StepsWalked walked = walk_in_style(walks, static_cast<int>(style));
    EXPECT_GE(walked.recognised, 0.95 * walked.cycles) << name;
    EXPECT_GT(walked.cycles, 5) << name;
    for (const Contact& contact : walked.contacts)
      joins.add(walked.poses, model.frame_rate, static_cast<std::size_t>(contact.frame),
                static_cast<std::size_t>(contact.frame) + 3);
    const FootSlide slide = foot_slide(walked.clip, body_roles(*model.body), walked.contacts);
    const double lowest = testing::lowest_of(walked.clip, body_roles(*model.body));
    std::printf("%s: %d of %d cycles recognised, %.1f mm slide, lowest point %.1f mm\n",
                name.c_str(), walked.recognised, walked.cycles, slide.mean, 1000 * lowest);
    EXPECT_LE(slide.mean, slide_limit(name)) << name;
    EXPECT_GT(lowest, -0.01) << name;
  }
  std::printf("joins: %.1f rad/s of training's %.1f, %.0f rad/s² of %.0f\n",
              percentile(joins.speeds, 0.999), percentile(training.speeds, 0.999),
              percentile(joins.accelerations, 0.999), percentile(training.accelerations, 0.999));
  EXPECT_LE(percentile(joins.speeds, 0.999), 1.1 * percentile(training.speeds, 0.999));
  EXPECT_LE(percentile(joins.accelerations, 0.999),
            1.1 * percentile(training.accelerations, 0.999));
}

// Nobody's feet are on the ground as those of the built-in walks: they slide by nothing at all.
TEST(StepWalkerWalks, in_built_in_styles_are_recognised_joined_smoothly_and_stand_on_the_ground) {
  expect_like_training(corpus_walks(), [](const std::string&) { return 0.5; });
}

TEST(StepWalkerWalks, in_captured_styles_are_recognised_joined_smoothly_and_slide_no_more) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-2");
  const auto slide = captured_slide(captured_walks());
  expect_like_training(captured_walks(), [&](const std::string& style) { return slide.at(style); });
}

void expect_human_between_styles(const StyledWalks& walks) {
  const Model& model = *walks.model;
  const testing::BendRange seen = testing::bends_of(walks.walks);
  double beyond = -9;
  for (std::size_t a = 0; a < model.styles.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      std::vector<float> weights(model.styles.size(), 0);
      weights[a] = weights[b] = 1;
      StepWalker walker(walks.model);
      ASSERT_TRUE(walker.set_weights(weights));
      WalkRecorder recorder(*model.body, model.frame_rate);
      for (int frame = 0; frame < 12 * model.frame_rate; ++frame) {
        walker.advance();
        recorder.add(walker.pose());
      }
      const Clip clip = recorder.clip("walked");
      testing::BendRange bends;
      bends.see(clip, model.body->roles);
      const std::string pair = model.styles[a] + " and " + model.styles[b];
      EXPECT_LE(seen.exceeded_by(bends), 0.01) << pair;
      beyond = std::max(beyond, seen.exceeded_by(bends));
      for (const double height : testing::lowest_points(clip, body_roles(*model.body))) {
        EXPECT_GT(height, -0.01) << pair;
        EXPECT_LT(height, 0.04) << pair;
      }
    }
  std::printf("beyond the training's knees and elbows by %.1f degrees at most\n",
              beyond * 180 / M_PI);
}

TEST(StepWalkerWalks, half_way_between_two_styles_are_still_human) {
  expect_human_between_styles(corpus_walks());
  if (std::filesystem::exists(testing::shared_data() / "bandai-namco-2"))
    expect_human_between_styles(captured_walks());
}

}  // namespace
}  // namespace gait
