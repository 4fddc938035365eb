// A reconstruction on stage whose input stops and comes back: nothing jumps, feet stay where they
// stand and above the ground.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numeric>

#include "gait/judge/foot_slide.h"
#include "gait/motion/contacts.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/resample.h"
#include "play/body/sole_height.h"
#include "play/change/stage_chain.h"
#include "play/cycles/styled_walks.h"

namespace gait {
namespace {

using testing::captured_walks;
using testing::corpus_walks;
using testing::JointMotion;
using testing::percentile;
using testing::Pose;
using testing::Shown;
using testing::StageChain;
using testing::StyledWalks;

// Values of the model's inputs at its rate, a column per frame.
Eigen::MatrixXf inputs_of(const Walk& walk, const Model& model) {
  const BodyPoses poses = body_poses(resampled(walk.clip, model.frame_rate), *model.body,
                                     match_joints(*model.body, walk.clip.skeleton, walk.clip.name),
                                     model.body->heading_window);
  return walk_sequence(*model.body, poses, {}, walk.clip.name).inputs.cast<float>();
}

// Frames of a sender at the model's rate, the first of them at `time`.
void feed(StageChain& chain, const Eigen::MatrixXf& inputs, int begin, int end, double time) {
  const double rate = chain.model().frame_rate;
  for (int i = begin; i < std::min(end, static_cast<int>(inputs.cols())); ++i)
    chain.feed(time + (i - begin) / rate,
               {inputs.col(i).data(), static_cast<std::size_t>(inputs.rows())});
}
void feed(StageChain& chain, const Eigen::MatrixXf& inputs, int begin, int end) {
  feed(chain, inputs, begin, end, begin / chain.model().frame_rate);
}

// Of the hips in the world: m/s, m/s².
struct RootMotions {
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
  RootMotions root_training, root_fed, root_losses, root_returns, root_after;
  std::vector<double> slides, own_slides;  // mm a stance; of those at hand-overs
  double lowest = 0;                       // of either foot, m
  std::vector<double> waited;              // seconds alone after poses came again
};

void add_training(const StyledWalks& walks, HandOvers& found) {
  const double rate = walks.model->frame_rate;
  const WalkSequences sequences = walk_sequences(walks.walks, {});
  for (const Sequence& sequence : sequences.sequences) {
    const std::vector<Pose> poses = testing::poses_of(sequence);
    found.training.add(poses, rate, 0, poses.size());
  }
  for (const Walk& walk : walks.walks) {
    const Clip clip = resampled(walk.clip, rate);
    const JointRoles roles = find_roles(clip.skeleton);
    const WorldPoses world = world_poses(clip);
    std::vector<Eigen::Vector3d> hips;
    for (int frame = 0; frame < clip.frames(); ++frame)
      hips.push_back(world.positions[static_cast<std::size_t>(frame) * clip.skeleton.joints.size() +
                                     static_cast<std::size_t>(roles.hips)]);
    found.root_training.add(hips, rate, 0, hips.size());
    const FootSlide slide =
        foot_slide(clip, roles,
                   walk.contacts.empty() ? follow_walk(clip, roles).contacts
                                         : contacts_at(walk.contacts, rate / walk.clip.frame_rate));
    found.own_slides.insert(found.own_slides.end(), slide.stances.begin(), slide.stances.end());
  }
}

// Each walk lost at several moments of its cycle for a second and a half.
HandOvers hand_overs(const StyledWalks& walks, int every) {
  const Model& model = *walks.model;
  const double rate = model.frame_rate;
  HandOvers found;
  add_training(walks, found);
  StageChain chain(walks.model);
  const JointRoles roles = body_roles(*model.body);
  for (std::size_t i = 0; i < walks.walks.size(); i += static_cast<std::size_t>(every)) {
    const Eigen::MatrixXf inputs = inputs_of(walks.walks[i], model);
    const int length = static_cast<int>(inputs.cols());
    for (int lost = 40; lost + 125 < length && lost < 76; lost += 7) {
      chain.reset();
      const Shown& shown = chain.shown();
      feed(chain, inputs, 0, lost);
      chain.lose();
      const std::size_t alone = shown.frames();
      chain.go_on(45);
      const std::size_t back = shown.frames();
      feed(chain, inputs, lost + 45, length);
      // Half a second to go over, and until the root is no longer gentle.
      const auto step = static_cast<std::size_t>(0.6 * rate),
                 gentle = static_cast<std::size_t>(1.6 * rate);
      auto settled = back;
      while (settled < shown.frames() && shown.alone[settled]) ++settled;
      found.waited.push_back(static_cast<double>(settled - back) / rate);
      found.losses.add(shown.poses, rate, alone, alone + step);
      found.returns.add(shown.poses, rate, back, settled + step);
      found.root_losses.add(shown.hips, rate, alone, alone + step);
      found.root_fed.add(shown.hips, rate, 10, alone);
      found.root_returns.add(shown.hips, rate, settled, settled + step);
      found.root_after.add(shown.hips, rate, settled + step, settled + gentle);
      const Clip clip = chain.clip();
      found.lowest = std::min(found.lowest, testing::lowest_of(clip, roles));
      const std::vector<Contact> contacts = shown.contacts();
      const FootSlide slide = foot_slide(clip, roles, contacts);
      for (std::size_t stance = 0; stance < slide.stances.size(); ++stance) {
        const auto at = static_cast<std::size_t>(contacts[stance].frame);
        if ((at + step > alone && at < alone + step) ||
            (at + step > settled && at < settled + gentle))
          found.slides.push_back(slide.stances[stance]);
      }
    }
  }
  return found;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

template <typename Motion>
void expect_within(const char* what, const Motion& ours, const Motion& reference, double share) {
  const auto ratio = [](const std::vector<double>& a, const std::vector<double>& b) {
    return percentile(a, 0.999) / percentile(b, 0.999);
  };
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
  expect_within("root against training, input lost", found.root_losses, found.root_training, 1.1);
  expect_within("root against training, input back", found.root_returns, found.root_training, 1.1);
  // From then on as ever while poses come.
  expect_within("root after that against one that was never lost", found.root_after, found.root_fed,
                1.1);
  std::printf(
      "%.1f mm a stance, %.0f at most in 95 %%, the walks' own %.1f and %.0f; lowest point %.1f "
      "mm\n",
      mean(found.slides), percentile(found.slides, 0.95), mean(found.own_slides),
      percentile(found.own_slides, 0.95), 1000 * found.lowest);
  EXPECT_GT(found.lowest, -0.01);
}

TEST(HandingOver, does_not_jump_when_the_input_of_built_in_walks_stops_and_returns) {
  const HandOvers found = hand_overs(corpus_walks(), 3);
  expect_no_jumps(found);
  // Drawn feet do not slide; reconstructed ones do by millimetres.
  EXPECT_LT(mean(found.slides), 8);
}

TEST(HandingOver, does_not_jump_when_the_input_of_captured_walks_stops_and_returns) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-2");
  const HandOvers found = hand_overs(captured_walks(), 2);
  expect_no_jumps(found);
  EXPECT_LE(mean(found.slides), mean(found.own_slides));
  EXPECT_LE(percentile(found.slides, 0.95), percentile(found.own_slides, 0.95));
}

const Eigen::MatrixXf& some_inputs() {
  static const Eigen::MatrixXf inputs =
      inputs_of(corpus_walks().walks.at(5), *corpus_walks().model);
  return inputs;
}

TEST(HandingOver, shows_outputs_as_they_were_made_soon_after_they_came_back) {
  int seen = 0;
  for (const std::size_t walk : {5, 20, 35, 50}) {
    StageChain chain(corpus_walks().model);
    const Eigen::MatrixXf inputs = inputs_of(corpus_walks().walks.at(walk), chain.model());
    feed(chain, inputs, 0, 60);
    chain.lose();
    chain.go_on(30);
    const std::vector<bool>& alone = chain.shown().alone;
    for (int i = 5; i < inputs.cols(); ++i) {
      feed(chain, inputs, i, i + 1, 10 + i / 30.0);
      if (std::find(alone.end() - 75, alone.end(), true) != alone.end()) continue;
      ++seen;
      const auto& joints = chain.model().body->output_joints;
      for (std::size_t joint = 0; joint < joints.size(); ++joint)
        for (std::size_t axis = 0; axis < 3; ++axis)
          ASSERT_EQ(chain.stage().pose()[3 * static_cast<std::size_t>(joints[joint]) + axis],
                    chain.synthesiser().outputs()[3 * joint + axis])
              << "frame " << i;
    }
  }
  EXPECT_GT(seen, 20);
}

TEST(HandingOver, bridges_poses_that_stop_again_at_once_and_another_walk_that_comes_next) {
  StageChain chain(corpus_walks().model);
  const double rate = chain.model().frame_rate;
  feed(chain, some_inputs(), 0, 60);
  chain.lose();
  chain.go_on(20);
  feed(chain, some_inputs(), 80, 84);  // four frames, then nothing again
  chain.lose();
  chain.go_on(20);
  feed(chain, some_inputs(), 104, 125);
  chain.lose();
  chain.go_on(60);
  feed(chain, inputs_of(corpus_walks().walks.at(40), chain.model()), 30, 150, 10);
  EXPECT_FALSE(chain.shown().alone.back());
  JointMotion all;
  all.add(chain.shown().poses, rate, 3, chain.shown().frames());
  EXPECT_LT(percentile(all.speeds, 1), 14);          // rad/s
  EXPECT_LT(percentile(all.accelerations, 1), 350);  // rad/s²
}

TEST(HandingOver, comes_to_rest_where_it_is_or_stops_when_told_so) {
  for (const OnLost what : {OnLost::hold, OnLost::stop}) {
    StageChain chain(corpus_walks().model, what);
    feed(chain, some_inputs(), 0, 60);
    chain.lose();
    chain.go_on(60);
    const Shown& shown = chain.shown();
    ASSERT_EQ(shown.frames(), what == OnLost::hold ? 120u : 60u);
    if (what == OnLost::hold) {
      for (std::size_t joint = 0; joint < shown.poses[0].size(); ++joint) {
        EXPECT_LT(angle_between(shown.poses[80][joint], shown.poses[119][joint]), 1e-6);
        EXPECT_LT(angle_between(shown.poses[59][joint], shown.poses[60][joint]), 0.35);
      }
      EXPECT_LT((shown.hips[119] - shown.hips[100]).norm(), 1e-3);
    }
    const std::size_t before = shown.frames();
    feed(chain, some_inputs(), 60, 110, 10);
    EXPECT_FALSE(shown.alone.back());
    // The measured joints are at once where they are measured; the legs go there.
    std::vector<Pose> legs;
    for (const Pose& pose : shown.poses) {
      legs.emplace_back();
      for (const int joint : chain.model().body->output_joints)
        legs.back().push_back(pose[static_cast<std::size_t>(joint)]);
    }
    JointMotion back;
    back.add(legs, 30, before - 1, legs.size());
    EXPECT_LT(percentile(back.speeds, 1), 12);  // rad/s; knees of the corpus reach 8
  }
}

TEST(HandingOver, walks_by_itself_when_no_pose_ever_came) {
  StageChain chain(corpus_walks().model);
  chain.go_on(90);
  EXPECT_EQ(chain.shown().frames(), 90u);
  EXPECT_GT(chain.shown().hips.back().z(), 1);
}

}  // namespace
}  // namespace gait
