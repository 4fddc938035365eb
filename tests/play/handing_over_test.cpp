// A reconstruction whose input stops and comes back.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "gait/motion/resample.h"
#include "gait/play/continuation.h"
#include "play/few_walks.h"
#include "play/forbidden_memory.h"
#include "play/joint_motion.h"
#include "play/styled_walks.h"

namespace gait {
namespace {

using testing::captured_walks;
using testing::corpus_walks;
using testing::ForbiddenMemory;
using testing::input_poses;
using testing::InputPoses;
using testing::JointMotion;
using testing::percentile;
using testing::Pose;
using testing::StyledWalks;

// Everything shown, frame after frame.
struct Shown {
  std::vector<Pose> poses;
  std::vector<Eigen::Vector3d> hips;
  std::vector<double> phases;
  std::vector<bool> alone;
  std::vector<double> times;

  void take(const Continuation& continuation) {
    const ReconstructedFrame& frame = continuation.frame();
    poses.emplace_back();
    for (const Eigen::Quaternionf& rotation : frame.pose)
      poses.back().push_back(rotation.cast<double>());
    hips.push_back(frame.hips.cast<double>());
    phases.push_back(frame.decision.phase);
    alone.push_back(continuation.alone());
    times.push_back(frame.time);
  }
};

void feed(Continuation& continuation, const InputPoses& inputs, int begin, int end, double rate,
          Shown& shown) {
  for (int i = begin; i < std::min(end, static_cast<int>(inputs.size())); ++i) {
    continuation.push(i / rate, inputs[static_cast<std::size_t>(i)]);
    while (continuation.next()) shown.take(continuation);
  }
}

void go_on(Continuation& continuation, int frames, Shown& shown) {
  for (int i = 0; i < frames; ++i)
    if (continuation.go_on()) shown.take(continuation);
}

// Inputs of a walk at the model's rate.
InputPoses inputs_of(const Walk& walk, const Model& model) {
  const BodyPoses poses = body_poses(resampled(walk.clip, model.frame_rate), *model.body,
                                     match_joints(*model.body, walk.clip.skeleton, walk.clip.name),
                                     model.body->heading_window);
  InputPoses inputs(static_cast<std::size_t>(poses.frames()));
  for (int frame = 0; frame < poses.frames(); ++frame)
    for (const int joint : model.body->input_joints)
      inputs[static_cast<std::size_t>(frame)].push_back(
          poses.pose(frame)[static_cast<std::size_t>(joint)].cast<float>());
  return inputs;
}

// Hips in the world, metres per second and its change.
struct RootMoves {
  std::vector<double> speeds, accelerations;

  void add(const std::vector<Eigen::Vector3d>& hips, double rate, std::size_t begin,
           std::size_t end) {
    for (std::size_t i = std::max<std::size_t>(2, begin); i < std::min(end, hips.size()); ++i) {
      speeds.push_back((hips[i] - hips[i - 1]).norm() * rate);
      accelerations.push_back((hips[i] - 2 * hips[i - 1] + hips[i - 2]).norm() * rate * rate);
    }
  }
};

struct HandOvers {
  JointMotion training, losses, returns;
  std::vector<double> waited;  // seconds alone after poses came again
  RootMoves root_training, root_fed, root_losses, root_returns;
};

// Each walk lost at several moments of its cycle for a second and a half.
HandOvers hand_overs(const StyledWalks& walks, int every) {
  const Model& model = *walks.model;
  const double rate = model.frame_rate;
  HandOvers found;
  const WalkSequences sequences = walk_sequences(walks.walks, {});
  for (const Sequence& sequence : sequences.sequences) {
    const std::vector<Pose> poses = testing::poses_of(sequence);
    found.training.add(poses, rate, 0, poses.size());
  }
  for (const Walk& walk : walks.walks) {
    const Clip clip = resampled(walk.clip, rate);
    const int hips_joint = find_roles(clip.skeleton).hips;
    const WorldPoses world = world_poses(clip);
    std::vector<Eigen::Vector3d> hips;
    for (int frame = 0; frame < clip.frames(); ++frame)
      hips.push_back(world.positions[static_cast<std::size_t>(frame) * clip.skeleton.joints.size() +
                                     static_cast<std::size_t>(hips_joint)]);
    found.root_training.add(hips, rate, 0, hips.size());
  }
  Continuation continuation(walks.model);
  for (std::size_t i = 0; i < walks.walks.size(); i += static_cast<std::size_t>(every)) {
    const InputPoses inputs = inputs_of(walks.walks[i], model);
    const int length = static_cast<int>(inputs.size());
    for (int lost = 40; lost + 125 < length && lost < 76; lost += 7) {
      continuation.reset();
      Shown shown;
      feed(continuation, inputs, 0, lost, rate, shown);
      const std::size_t alone = shown.poses.size();
      go_on(continuation, 45, shown);
      const std::size_t back = shown.poses.size();
      feed(continuation, inputs, lost + 45, length, rate, shown);
      const auto step = static_cast<std::size_t>(0.6 * rate);
      auto settled = back;
      while (settled < shown.poses.size() && shown.alone[settled]) ++settled;
      found.waited.push_back(static_cast<double>(settled - back) / rate);
      found.losses.add(shown.poses, rate, alone, alone + step);
      found.returns.add(shown.poses, rate, back, settled + step);
      found.root_fed.add(shown.hips, rate, 10, alone);
      found.root_losses.add(shown.hips, rate, alone, alone + step);
      found.root_returns.add(shown.hips, rate, back, settled + step);
    }
  }
  return found;
}

double ratio(const std::vector<double>& ours, const std::vector<double>& theirs) {
  return percentile(ours, 0.999) / percentile(theirs, 0.999);
}

template <typename Motion>
void expect_within(const char* what, const Motion& ours, const Motion& reference, double share) {
  const double speed = ratio(ours.speeds, reference.speeds),
               acceleration = ratio(ours.accelerations, reference.accelerations);
  std::printf("%s: speed %.2f, acceleration %.2f of %.1f and %.1f\n", what, speed, acceleration,
              percentile(reference.speeds, 0.999), percentile(reference.accelerations, 0.999));
  EXPECT_LE(speed, share) << what;
  EXPECT_LE(acceleration, share) << what;
}

void expect_no_jumps(const HandOvers& found) {
  std::printf("waited %.2f s in the median, %.2f s at most; %zu hand-overs\n",
              percentile(found.waited, 0.5), percentile(found.waited, 1), found.waited.size());
  EXPECT_LT(percentile(found.waited, 1), 2.5);
  expect_within("joints against training, input lost", found.losses, found.training, 1.1);
  expect_within("joints against training, input back", found.returns, found.training, 1.1);
}

TEST(HandingOver, does_not_jump_when_the_input_of_built_in_walks_stops_and_returns) {
  const HandOvers found = hand_overs(corpus_walks(), 3);
  expect_no_jumps(found);
  // The built-in walks' roots hardly accelerate at all (5 m/s²); captured ones reach 14 m/s².
  EXPECT_LT(percentile(found.root_losses.accelerations, 0.999), 15);
  EXPECT_LT(percentile(found.root_returns.accelerations, 0.999), 15.7);
  EXPECT_LE(ratio(found.root_returns.speeds, found.root_training.speeds), 1.1);
}

// A root that follows reconstructed feet is a little rougher than a captured one, for the legs are
// a few degrees off and the feet with them: smoother, and they would slide more than captured ones.
TEST(HandingOver, does_not_jump_when_the_input_of_captured_walks_stops_and_returns) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-2");
  const HandOvers found = hand_overs(captured_walks(), 2);
  expect_no_jumps(found);
  std::printf("root while poses come: %.2f of training's acceleration\n",
              ratio(found.root_fed.accelerations, found.root_training.accelerations));
  EXPECT_LE(ratio(found.root_fed.accelerations, found.root_training.accelerations), 1.35);
  expect_within("root against training, input lost", found.root_losses, found.root_training, 1.25);
  expect_within("root against training, input back", found.root_returns, found.root_training, 1.3);
}

const InputPoses& some_inputs() {
  static const InputPoses inputs = inputs_of(corpus_walks().walks[5], *corpus_walks().model);
  return inputs;
}

TEST(HandingOver, changes_nothing_while_poses_come) {
  const Model& model = *corpus_walks().model;
  Continuation continuation(corpus_walks().model);
  Reconstructor reconstructor(corpus_walks().model);
  for (std::size_t i = 0; i < some_inputs().size(); ++i) {
    const double time = static_cast<double>(i) / model.frame_rate;
    continuation.push(time, some_inputs()[i]);
    reconstructor.push(time, some_inputs()[i]);
    ASSERT_EQ(continuation.next(), reconstructor.next());
    EXPECT_FALSE(continuation.alone());
    const ReconstructedFrame &a = continuation.frame(), &b = reconstructor.frame();
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.hips, b.hips);
    EXPECT_TRUE(std::ranges::equal(a.outputs, b.outputs));
    EXPECT_TRUE(std::ranges::equal(a.styles, b.styles));
    for (std::size_t joint = 0; joint < a.pose.size(); ++joint)
      EXPECT_EQ(a.pose[joint].coeffs(), b.pose[joint].coeffs());
  }
}

TEST(HandingOver, goes_on_in_step) {
  Continuation continuation(corpus_walks().model);
  const double rate = corpus_walks().model->frame_rate;
  Shown shown;
  feed(continuation, some_inputs(), 0, 60, rate, shown);
  const double cadence = continuation.frame().decision.cadence;
  go_on(continuation, 60, shown);
  ASSERT_EQ(shown.poses.size(), 120u);
  for (std::size_t i = 60; i < 120; ++i) {
    EXPECT_TRUE(shown.alone[i]);
    EXPECT_NEAR(shown.times[i] - shown.times[i - 1], 1 / rate, 1e-9);
    // Two steps a cycle; within the tempo that a step walker takes over.
    const double moved = std::remainder(shown.phases[i] - shown.phases[i - 1], 1.0) * rate * 2;
    EXPECT_NEAR(moved, cadence, 0.05 * cadence) << "frame " << i;
  }
  EXPECT_GT(shown.hips.back().z() - shown.hips[60].z(), 0.5);  // it walks away
}

TEST(HandingOver, knows_the_style_it_was_in) {
  const StyledWalks& walks = corpus_walks();
  Continuation continuation(walks.model);
  int right = 0, lost = 0;
  for (std::size_t i = 0; i < walks.walks.size(); i += 4) {
    const InputPoses inputs = inputs_of(walks.walks[i], *walks.model);
    continuation.reset();
    Shown shown;
    feed(continuation, inputs, 0, 80, walks.model->frame_rate, shown);
    go_on(continuation, 10, shown);
    const auto styles = continuation.frame().styles;
    const auto best = std::ranges::max_element(styles) - styles.begin();
    right += walks.model->styles[static_cast<std::size_t>(best)] == walks.walks[i].style;
    ++lost;
  }
  EXPECT_GE(right, 0.9 * lost);
}

TEST(HandingOver, holds_its_pose_when_told_so) {
  Continuation continuation(corpus_walks().model);
  continuation.set_on_lost(OnLost::hold);
  const double rate = corpus_walks().model->frame_rate;
  Shown shown;
  EXPECT_FALSE(continuation.go_on());  // nothing to hold
  feed(continuation, some_inputs(), 0, 60, rate, shown);
  go_on(continuation, 60, shown);
  ASSERT_EQ(shown.poses.size(), 120u);
  EXPECT_EQ(continuation.frame().decision.cadence, 0);
  for (std::size_t joint = 0; joint < shown.poses[0].size(); ++joint) {
    // Comes to rest within half a second, and near where it was: a joint at 7 rad/s runs on a
    // little.
    EXPECT_LT(angle_between(shown.poses[80][joint], shown.poses[119][joint]), 1e-6);
    EXPECT_LT(angle_between(shown.poses[59][joint], shown.poses[119][joint]), 1e-3);
    EXPECT_LT(angle_between(shown.poses[59][joint], shown.poses[60][joint]), 0.35);
  }
  EXPECT_LT((shown.hips[119] - shown.hips[90]).norm(), 1e-3);
}

TEST(HandingOver, stops_when_told_so_and_returns_without_a_jump) {
  Continuation continuation(corpus_walks().model);
  continuation.set_on_lost(OnLost::stop);
  const double rate = corpus_walks().model->frame_rate;
  Shown shown;
  feed(continuation, some_inputs(), 0, 60, rate, shown);
  go_on(continuation, 30, shown);
  ASSERT_EQ(shown.poses.size(), 60u);
  const int all = static_cast<int>(some_inputs().size());
  ASSERT_GT(all, 120);
  feed(continuation, some_inputs(), 90, all, rate, shown);
  ASSERT_EQ(shown.poses.size(), static_cast<std::size_t>(all - 30));
  EXPECT_FALSE(shown.alone.back());
  JointMotion back;
  back.add(shown.poses, rate, 61, shown.poses.size());
  EXPECT_LT(percentile(back.speeds, 1), 12);  // rad/s; knees of the corpus reach 8
}

TEST(HandingOver, walks_by_itself_when_no_pose_ever_came) {
  Continuation continuation(corpus_walks().model);
  Shown shown;
  go_on(continuation, 90, shown);
  EXPECT_EQ(shown.poses.size(), 90u);
  EXPECT_GT(shown.hips.back().z(), 1);
}

TEST(HandingOver, bridges_poses_that_stop_again_at_once_and_gaps_that_nobody_announced) {
  const double rate = corpus_walks().model->frame_rate;
  Continuation continuation(corpus_walks().model);
  Shown shown;
  feed(continuation, some_inputs(), 0, 60, rate, shown);
  go_on(continuation, 20, shown);
  feed(continuation, some_inputs(), 80, 84, rate, shown);  // four frames, then nothing again
  go_on(continuation, 20, shown);
  feed(continuation, some_inputs(), 104, 125, rate, shown);
  for (int i = 60; i < 110; ++i) {  // two seconds later, as if it were another walk
    continuation.push(10 + i / rate, some_inputs()[static_cast<std::size_t>(i)]);
    while (continuation.next()) shown.take(continuation);
  }
  EXPECT_FALSE(shown.alone.back());
  JointMotion all;
  all.add(shown.poses, rate, 3, shown.poses.size());
  EXPECT_LT(percentile(all.speeds, 1), 14);          // rad/s
  EXPECT_LT(percentile(all.accelerations, 1), 350);  // rad/s²
}

TEST(HandingOver, takes_over_another_model_in_mid_walk) {
  const double rate = corpus_walks().model->frame_rate;
  for (const bool lost : {false, true}) {
    Continuation before(corpus_walks().model), after(corpus_walks().model);
    Shown shown;
    feed(before, some_inputs(), 0, 60, rate, shown);
    if (lost) go_on(before, 20, shown);
    before.walker().queue(0);
    ASSERT_TRUE(after.take_over(before));
    EXPECT_EQ(after.walker().queued(), before.walker().queued());
    feed(after, some_inputs(), 60, 140, rate, shown);
    EXPECT_FALSE(shown.alone.back());
    JointMotion all;
    all.add(shown.poses, rate, 3, shown.poses.size());
    EXPECT_LT(percentile(all.speeds, 1), 12);
  }
  Continuation small(testing::few_walks_model()), large(corpus_walks().model);
  EXPECT_FALSE(small.take_over(large));
}

TEST(HandingOver, takes_no_memory) {
  if (!ForbiddenMemory::works()) GTEST_SKIP() << "a sanitizer has malloc";
  const InputPoses& inputs = some_inputs();
  Continuation continuation(corpus_walks().model), other(corpus_walks().model);
  long allocations = 0, releases = 0;
  int frames = 0;
  {
    const ForbiddenMemory forbidden;
    for (int i = 0; i < 100; ++i) {
      const bool lost = i >= 40 && i < 60;
      if (!lost) continuation.push(i / 30.0, inputs[static_cast<std::size_t>(i)]);
      frames += lost ? continuation.go_on() : continuation.next();
      if (i == 70) other.take_over(continuation);
    }
    continuation.reset();
    allocations = forbidden.allocations(), releases = forbidden.releases();
  }
  EXPECT_EQ(frames, 100);
  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(releases, 0);
}

}  // namespace
}  // namespace gait
