// The synthesiser as whoever feeds it, and whoever stops feeding it, sees it.
#include "gait/play/synthesise/synthesiser.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "play/change/joint_motion.h"
#include "play/cycles/styled_walks.h"
#include "play/few_walks.h"
#include "play/forbidden_memory.h"
#include "play/played_stream.h"
#include "play/synthesise/told_gaussians.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::ForbiddenMemory;
using testing::held_out_inputs;
using testing::JointMotion;
using testing::largest_difference;
using testing::percentile;
using testing::Pose;
using testing::Told;
using testing::told_gaussians;

using Frames = std::vector<std::vector<float>>;

const std::vector<Told>& sad_walk() {
  static const std::vector<Told> told = told_gaussians(few_walks_model(), held_out_inputs("sad"));
  return told;
}

bool feed(Synthesiser& synthesiser, const Told& told, bool with_place = true) {
  if (with_place) {
    EXPECT_TRUE(synthesiser.set_place(told.phase, told.cadence, told.styles));
  }
  return synthesiser.push(told.means, told.variances);
}

void keep(const Synthesiser& synthesiser, Frames& frames) {
  frames.emplace_back(synthesiser.outputs().begin(), synthesiser.outputs().end());
}

testing::Played played(int past, int future) {
  PlaySettings settings;
  settings.decoder = DecoderKind::forward;
  settings.past = past, settings.future = future;
  StreamReconstructor reconstructor(few_walks_model(), settings);
  return testing::play_through(reconstructor, held_out_inputs("sad"));
}

TEST(Synthesiser, fed_with_a_walks_gaussians_gives_the_outputs_of_its_reconstruction) {
  for (const auto& [past, future] :
       {std::pair(20, 0), {8, 3}, {0, 0}, {3, 7}, {whole_past, 0}, {whole_past, 7}}) {
    const testing::Played expected = played(past, future);
    Synthesiser synthesiser(few_walks_model(), {past, future});
    Frames frames;
    for (const Told& told : sad_walk())
      if (feed(synthesiser, told)) keep(synthesiser, frames);
    ASSERT_EQ(frames.size(), sad_walk().size() - static_cast<std::size_t>(future));
    // What the future held back comes when the input stops, and only then a walk of its own.
    for (int i = 0; i < future; ++i) {
      ASSERT_TRUE(synthesiser.go_on());
      EXPECT_FALSE(synthesiser.alone());
      keep(synthesiser, frames);
    }
    ASSERT_EQ(frames.size(), expected.outputs.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
      ASSERT_EQ(frames[i], expected.outputs[i]) << past << ", " << future << ": frame " << i;
    ASSERT_TRUE(synthesiser.go_on());
    EXPECT_TRUE(synthesiser.alone());
  }
}

// The model without its last output value, which then is one that does not move.
std::shared_ptr<const Model> model_without_last_output() {
  auto model = std::make_shared<Model>(*few_walks_model());
  const int inputs = model->input.size(), outputs = model->output.statics();
  const int of_input = model->input.statics(), all = model->trajectory_values();
  std::vector<int> z, y, path;  // what stays
  for (int i = 0; i < inputs + 3 * outputs; ++i)
    if (i < inputs || (i - inputs) % outputs != outputs - 1) z.push_back(i);
  for (int i = 0; i < 3 * outputs; ++i)
    if (i % outputs != outputs - 1) y.push_back(i);
  for (int i = 0; i < 3 * all; ++i)
    if (i % all != of_input + outputs - 1) path.push_back(i);
  for (Eigen::VectorXd* vector : {&model->output_scaling.mean, &model->output_scaling.deviation})
    *vector = Eigen::VectorXd((*vector)(y));
  for (Label& label : model->labels)
    for (State& state : label.states) {
      state.mean = Eigen::VectorXd(state.mean(z));
      state.covariance = Eigen::MatrixXd(state.covariance(z, z));
      state.style_means = Eigen::MatrixXd(state.style_means(z, Eigen::all));
      state.trajectory_means = Eigen::MatrixXd(state.trajectory_means(path, Eigen::all));
      state.trajectory_variances = Eigen::VectorXd(state.trajectory_variances(path));
    }
  model->output.modelled.pop_back();
  return model;
}

TEST(Synthesiser, keeps_told_means_of_values_that_do_not_move_in_time_with_the_others) {
  const auto model = model_without_last_output();
  const auto last = static_cast<std::size_t>(model->output.values - 1);
  std::vector<Told> walk = told_gaussians(model, held_out_inputs("sad"));
  PlaySettings settings;
  settings.decoder = DecoderKind::forward;
  settings.past = 20, settings.future = 2;
  StreamReconstructor reconstructor(model, settings);
  const testing::Played expected = testing::play_through(reconstructor, held_out_inputs("sad"));
  Synthesiser synthesiser(model, {20, 2});
  for (std::size_t i = 0; i < walk.size(); ++i) {
    EXPECT_EQ(walk[i].variances[last], 0);
    walk[i].means[last] = static_cast<float>(i);
    if (!feed(synthesiser, walk[i])) continue;
    std::vector<float> outputs(synthesiser.outputs().begin(), synthesiser.outputs().end());
    EXPECT_EQ(outputs.back(), static_cast<float>(i - 2));
    outputs.back() = expected.outputs[i - 2].back();
    ASSERT_EQ(outputs, expected.outputs[i - 2]);
  }
}

TEST(Synthesiser, alone_is_a_step_walker_with_the_whole_body) {
  const auto model = few_walks_model();
  Synthesiser synthesiser(model);
  StepWalker walker(model);
  for (int frame = 0; frame < 120; ++frame) {
    ASSERT_TRUE(synthesiser.go_on());
    walker.advance();
    ASSERT_TRUE(std::ranges::equal(synthesiser.outputs(), walker.outputs())) << frame;
    ASSERT_EQ(synthesiser.pose().size(), 3 * walker.pose().size());
    for (std::size_t joint = 0; joint < walker.pose().size(); ++joint) {
      const Eigen::Quaternionf rotation =
          rotation_from<float>(synthesiser.pose().subspan(3 * joint).first<3>(),
                               model->body->references[joint].cast<float>());
      EXPECT_LT(angle_between(rotation, walker.pose()[joint]), 1e-5f);
    }
    EXPECT_TRUE(synthesiser.walks());
  }
}

// Outputs of one frame as rotations.
Pose rotations(const std::vector<float>& frame) {
  Pose pose;
  for (std::size_t at = 0; at < frame.size(); at += 3)
    pose.push_back(
        exponential_map<double>(Eigen::Vector3d(frame[at], frame[at + 1], frame[at + 2])));
  return pose;
}

JointMotion motion_of(const Frames& frames, std::size_t begin, std::size_t end) {
  std::vector<Pose> poses;
  for (const auto& frame : frames) poses.push_back(rotations(frame));
  JointMotion motion;
  motion.add(poses, 30, begin, end);
  return motion;
}

// Outputs of training walks.
JointMotion training(const std::vector<Walk>& walks) {
  const WalkSequences sequences = walk_sequences(walks, {});
  JointMotion motion;
  for (const Sequence& sequence : sequences.sequences) {
    std::vector<Pose> poses;
    for (int frame = sequence.segments.front().begin; frame < sequence.segments.back().end;
         ++frame) {
      poses.emplace_back();
      for (Eigen::Index at = 0; at < sequence.outputs.rows(); at += 3)
        poses.back().push_back(
            exponential_map<double>(Eigen::Vector3d(sequence.outputs.col(frame).segment<3>(at))));
    }
    motion.add(poses, 30, 0, poses.size());
  }
  return motion;
}

struct CutOff {
  JointMotion lost, back, blocked;
  std::vector<double> waited;
};

// Each walk cut at several moments for a second and a half, by a stream that says so after
// `noticed` seconds, or by a cord that is shut. `with_place`: when it returns it is said where.
CutOff cut_off(const testing::StyledWalks& walks, bool with_place, float noticed) {
  CutOff found;
  Synthesiser synthesiser(walks.model);
  const WalkSequences sequences = walk_sequences(walks.walks, {});
  for (std::size_t walk = 0; walk < sequences.sequences.size(); walk += 4) {
    const auto told = told_gaussians(walks.model, sequences.sequences[walk].inputs.cast<float>());
    for (std::size_t lost = 40; lost + 125 < told.size() && lost < 76; lost += 7) {
      synthesiser.reset();
      Frames frames;
      for (std::size_t i = 0; i < lost; ++i)
        if (feed(synthesiser, told[i], false)) keep(synthesiser, frames);
      // It takes a while until a loss is noticed; the phase goes on meanwhile.
      const Told& last = told[lost - 1];
      EXPECT_TRUE(synthesiser.set_place(last.phase + noticed * last.cadence / 2, last.cadence,
                                        last.styles));
      for (int i = 0; i < 45; ++i)
        if (synthesiser.go_on()) keep(synthesiser, frames);
      std::size_t settled = 0;
      for (std::size_t i = lost + 45; i < told.size(); ++i) {
        if (feed(synthesiser, told[i], with_place)) keep(synthesiser, frames);
        if (synthesiser.alone()) settled = frames.size();
      }
      EXPECT_EQ(frames.size(), told.size());
      EXPECT_GT(settled, lost);
      found.waited.push_back(static_cast<double>(settled - lost - 45) / 30);
      const auto motion = [&](std::size_t begin, std::size_t end, JointMotion& into) {
        const JointMotion part = motion_of(frames, begin, end);
        into.speeds.insert(into.speeds.end(), part.speeds.begin(), part.speeds.end());
        into.accelerations.insert(into.accelerations.end(), part.accelerations.begin(),
                                  part.accelerations.end());
      };
      motion(lost, lost + 18, found.lost);
      motion(lost + 45, settled + 18, found.back);

      // The cord was shut and opened again: nobody said so.
      synthesiser.reset();
      frames.clear();
      for (std::size_t i = 0; i < told.size(); ++i)
        if ((i < lost || i >= lost + 45) &&
            synthesiser.push(told[i].means, told[i].variances, i == lost + 45))
          keep(synthesiser, frames);
      motion(lost, lost + 18, found.blocked);
    }
  }
  return found;
}

void compare(const char* what, const JointMotion& ours, const JointMotion& theirs, double speed,
             double acceleration) {
  const auto ratio = [](const auto& a, const auto& b, double share) {
    return percentile(a, share) / percentile(b, share);
  };
  std::printf("%s against training: speed %.2f (largest %.2f), acceleration %.2f (largest %.2f)\n",
              what, ratio(ours.speeds, theirs.speeds, 0.999), ratio(ours.speeds, theirs.speeds, 1),
              ratio(ours.accelerations, theirs.accelerations, 0.999),
              ratio(ours.accelerations, theirs.accelerations, 1));
  EXPECT_LE(ratio(ours.speeds, theirs.speeds, 0.999), speed) << what;
  EXPECT_LE(ratio(ours.accelerations, theirs.accelerations, 0.999), acceleration) << what;
}

TEST(Synthesiser, does_not_jump_when_the_stream_stops_and_returns) {
  const testing::StyledWalks& walks = testing::corpus_walks();
  const JointMotion taught = training(walks.walks);
  for (const auto& [with_place, noticed] : {std::pair(true, 0.0f), {true, 0.25f}, {false, 0.25f}}) {
    const CutOff found = cut_off(walks, with_place, noticed);
    std::printf(
        "noticed after %.2f s, %s: waited %.2f s in the median, %.2f s at most, %zu times\n",
        static_cast<double>(noticed), with_place ? "told where the walk is" : "not told",
        percentile(found.waited, 0.5), percentile(found.waited, 1), found.waited.size());
    compare("stream lost", found.lost, taught, 1.1, 1.1);
    compare("stream back", found.back, taught, 1.1, 1.1);
    compare("cord shut and opened", found.blocked, taught, 1.1, 1.1);
    EXPECT_LT(percentile(found.waited, 1), 2.5);
  }
}

TEST(Synthesiser, walks_on_in_step_and_in_style) {
  const auto model = testing::corpus_walks().model;
  const WalkSequences sequences = walk_sequences(testing::corpus_walks().walks, {});
  const auto told = told_gaussians(model, sequences.sequences[9].inputs.cast<float>());
  Synthesiser synthesiser(model);
  for (std::size_t i = 0; i < 70; ++i) feed(synthesiser, told[i], i == 69);
  float phase = told[69].phase;
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(synthesiser.go_on());
    const float now = synthesiser.walker().phase();
    const float moved = std::remainder(now - phase, 1.0f) * 30 * 2;  // two steps a cycle
    EXPECT_NEAR(moved, told[69].cadence, 0.06f * told[69].cadence) << i;
    phase = now;
  }
  const auto& said = told[69].styles;
  const auto best = std::ranges::max_element(said) - said.begin();
  Eigen::Index walked = 0;
  synthesiser.walker().weights().maxCoeff(&walked);
  EXPECT_EQ(walked, best);
}

TEST(Synthesiser, holds_or_stops_when_told_so_and_stands_when_it_stood) {
  for (const char* how : {"hold", "stood"}) {
    Synthesiser synthesiser(few_walks_model());
    if (how == std::string("hold")) {
      synthesiser.set_on_lost(OnLost::hold);
      EXPECT_FALSE(synthesiser.go_on()) << "nothing to hold";
      synthesiser.reset();
    } else {
      synthesiser.set_walking(false);
    }
    Frames frames;
    for (std::size_t i = 0; i < 60; ++i)
      if (feed(synthesiser, sad_walk()[i])) keep(synthesiser, frames);
    for (int i = 0; i < 40; ++i) {
      ASSERT_TRUE(synthesiser.go_on());
      keep(synthesiser, frames);
      EXPECT_FALSE(synthesiser.walks());
    }
    EXPECT_EQ(frames[80], frames[99]) << how;
    EXPECT_LT(largest_difference(frames[59], frames[99]), 1e-3) << how;
    EXPECT_LT(largest_difference(frames[59], frames[60]), 0.3) << how;
    // Told that the body steps again it walks from there; told to walk on when lost, too.
    synthesiser.set_walking(true);
    synthesiser.set_on_lost(OnLost::walk);
    for (int i = 0; i < 40; ++i) ASSERT_TRUE(synthesiser.go_on());
    EXPECT_TRUE(synthesiser.walks());
    EXPECT_GT(largest_difference(synthesiser.outputs(), frames[99]), 0.05);
  }
  Synthesiser synthesiser(few_walks_model());
  synthesiser.set_on_lost(OnLost::stop);
  for (std::size_t i = 0; i < 60; ++i) feed(synthesiser, sad_walk()[i]);
  const std::vector<float> last(synthesiser.outputs().begin(), synthesiser.outputs().end());
  EXPECT_FALSE(synthesiser.go_on());
  EXPECT_FALSE(synthesiser.go_on());
  EXPECT_TRUE(std::ranges::equal(last, synthesiser.outputs()));
  Frames frames{last};
  for (std::size_t i = 80; i < 120; ++i)
    if (feed(synthesiser, sad_walk()[i])) keep(synthesiser, frames);
  EXPECT_GT(frames.size(), 25u);
  EXPECT_FALSE(synthesiser.alone());
  EXPECT_LT(percentile(motion_of(frames, 0, frames.size()).speeds, 1), 12);
}

TEST(Synthesiser, bends_single_joints_whether_it_is_fed_or_alone) {
  const int stream = static_cast<int>(few_walks_model()->inputs.size()) + 1;  // the second output
  Synthesiser plain(few_walks_model()), bent(few_walks_model());
  const std::vector<float> by{0.1f, 0, -0.2f};
  ASSERT_TRUE(bent.set_shift(stream, by));
  for (std::size_t i = 0; i < 90; ++i) {
    if (i < 60)
      feed(plain, sad_walk()[i]), feed(bent, sad_walk()[i]);
    else
      plain.go_on(), bent.go_on();
    for (std::size_t value = 0; value < plain.outputs().size(); ++value) {
      const float difference = bent.outputs()[value] - plain.outputs()[value];
      const float expected = value >= 3 && value < 6 ? by[value - 3] : 0.0f;
      ASSERT_NEAR(difference, expected, 1e-4) << "frame " << i << ", value " << value;
    }
  }
  ASSERT_TRUE(bent.free(stream));
  for (int i = 0; i < 60; ++i) plain.go_on(), bent.go_on();
  EXPECT_LT(largest_difference(plain.outputs(), bent.outputs()), 1e-3);
}

TEST(Synthesiser, takes_another_queue_in_mid_walk_without_a_jump) {
  Synthesiser synthesiser(few_walks_model(), {20, 0});
  Frames frames;
  for (std::size_t i = 0; i < 110; ++i) {
    if (i == 50) synthesiser.set_future(3);
    if (i == 70) synthesiser.set_past(10);
    if (i == 80) synthesiser.set_future(0);
    ASSERT_TRUE(feed(synthesiser, sad_walk()[i]));  // no frame goes missing
    keep(synthesiser, frames);
  }
  const JointMotion motion = motion_of(frames, 0, frames.size());
  EXPECT_LT(percentile(motion.speeds, 1), 9);           // rad/s
  EXPECT_LT(percentile(motion.accelerations, 1), 250);  // rad/s²
  const testing::Played expected = played(10, 0);
  EXPECT_LT(largest_difference(frames[109], expected.outputs[109]), 1e-5);
}

TEST(Synthesiser, lets_bad_input_pass_unnoticed) {
  Synthesiser synthesiser(few_walks_model()), untouched(few_walks_model());
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < 40; ++i) {
    Told bad = sad_walk()[i];
    bad.means[2] = nan;
    EXPECT_FALSE(synthesiser.push(bad.means, bad.variances));
    bad = sad_walk()[i];
    bad.variances[static_cast<std::size_t>(few_walks_model()->output.modelled[0])] = 0;
    EXPECT_FALSE(synthesiser.push(bad.means, bad.variances));
    EXPECT_FALSE(synthesiser.push(bad.means, {}));
    EXPECT_FALSE(synthesiser.set_place(nan, 1, bad.styles));
    EXPECT_FALSE(synthesiser.set_place(0, 1, std::vector<float>(99, 0.1f)));
    EXPECT_FALSE(synthesiser.set_scale(-1, 1));
    EXPECT_FALSE(synthesiser.set_scale(999, 1));
    EXPECT_FALSE(synthesiser.fix(0, std::vector<float>{nan, 0, 0}));
    EXPECT_EQ(feed(synthesiser, sad_walk()[i]), feed(untouched, sad_walk()[i]));
    ASSERT_TRUE(std::ranges::equal(synthesiser.outputs(), untouched.outputs()));
  }
}

TEST(Synthesiser, lives_on_in_another_model_of_equal_sizes) {
  const auto other_model = std::make_shared<const Model>(*few_walks_model());
  for (const bool alone : {false, true}) {
    Synthesiser before(few_walks_model()), after(other_model);
    Frames frames;
    before.walker().set_style(1);
    for (std::size_t i = 0; i < 60; ++i) {
      if (alone)
        before.go_on();
      else
        feed(before, sad_walk()[i]);
      keep(before, frames);
    }
    before.walker().queue(1);
    ASSERT_TRUE(after.take_over(before));
    EXPECT_EQ(after.walker().queued(), before.walker().queued());
    for (std::size_t i = 60; i < 100; ++i) {
      if (alone)
        after.go_on(), before.go_on();
      else
        feed(after, sad_walk()[i]), feed(before, sad_walk()[i]);
      keep(after, frames);
      if (alone) {
        EXPECT_TRUE(std::ranges::equal(after.outputs(), before.outputs()));
      }
    }
    EXPECT_LT(percentile(motion_of(frames, 0, frames.size()).speeds, 1), 9);
    EXPECT_LT(largest_difference(after.outputs(), before.outputs()), 1e-5);
  }
  Synthesiser small(few_walks_model());
  EXPECT_FALSE(small.take_over(Synthesiser(testing::corpus_walks().model)));
}

TEST(Synthesiser, takes_no_memory) {
  if (!ForbiddenMemory::works()) GTEST_SKIP() << "a sanitizer has malloc";
  sad_walk();
  Synthesiser synthesiser(few_walks_model(), {20, 2});
  const std::vector<float> by{0.1f, 0, 0};
  long allocations = 0, releases = 0;
  int frames = 0;
  {
    const ForbiddenMemory forbidden;
    for (std::size_t i = 0; i < 110; ++i) {
      const bool lost = i >= 40 && i < 60;
      if (!lost) synthesiser.set_place(sad_walk()[i].phase, 2, sad_walk()[i].styles);
      frames += lost ? synthesiser.go_on()
                     : synthesiser.push(sad_walk()[i].means, sad_walk()[i].variances);
      if (i == 50) synthesiser.walker().queue(0);
      if (i == 80) synthesiser.set_shift(2, by);
    }
    synthesiser.reset();
    allocations = forbidden.allocations(), releases = forbidden.releases();
  }
  EXPECT_EQ(frames, 108);
  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(releases, 0);
}

}  // namespace
}  // namespace gait
