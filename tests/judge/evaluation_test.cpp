#include "gait/judge/evaluation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gait/error.h"
#include "gait/judge/played_sequence.h"
#include "play/few_walks.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::plan_of;
using testing::streams_of;
using testing::walk_of;

std::vector<Walk> unseen_walks() {
  return {walk_of(make_walk(plan_of("sad", 9))), walk_of(make_walk(plan_of("in-a-hurry", 9))),
          walk_of(make_walk(plan_of("heavy", 9)))};
}

const Evaluation& evaluation() {
  static const Evaluation done = evaluate(few_walks_model(), unseen_walks(), {});
  return done;
}

TEST(Evaluation, each_stage_adds_something) {
  const Evaluation& all = evaluation();
  ASSERT_EQ(all.clips.size(), 3u);
  for (const auto mean : {&Means::over_clips, &Means::pooled}) {
    EXPECT_GT(all.error(Estimate::mean_pose).*mean, all.error(Estimate::state_means).*mean);
    EXPECT_GT(all.error(Estimate::state_means).*mean, all.error(Estimate::mapped).*mean);
    EXPECT_LT(all.error(Estimate::synthesised).*mean, all.error(Estimate::mapped).*mean + 0.001);
    EXPECT_GT(all.step_accuracy().*mean, 0.9);
  }
  for (const EvaluatedClip& clip : all.clips) {
    EXPECT_LT(clip.jerk_synthesised, clip.jerk_mapped) << clip.name;
    EXPECT_GT(clip.jerk_truth, 0);
    EXPECT_NEAR(clip.path_synthesised / clip.path_captured, 1, 0.15) << clip.name;
    EXPECT_GE(clip.slide_captured, 0);
    EXPECT_GT(clip.slide_synthesised, 0);
  }
}

TEST(Evaluation, times_contacts_as_a_patch_hears_them) {
  const Evaluation& all = evaluation();
  const ContactErrors impulses = all.contacts(Heard::impulse);
  EXPECT_GT(impulses.touched, 10);
  EXPECT_EQ(impulses.missed, 0);
  EXPECT_EQ(impulses.extra, 0);
  EXPECT_EQ(impulses.late.size(), static_cast<std::size_t>(impulses.touched));
  EXPECT_LE(std::abs(impulses.mean()), 0.02);
  EXPECT_LE(impulses.deviation(), 0.03);
  EXPECT_LE(impulses.quantile(0.05), impulses.quantile(0.95));
  // The message leaves when its block of audio is done.
  const double later = all.contacts(Heard::contact).mean() - impulses.mean();
  EXPECT_GT(later, 0);
  EXPECT_LE(later, 64.0 / 48000);
  ContactErrors of_styles;
  for (const EvaluatedClip& clip : all.clips)
    of_styles.add(all.contacts(Heard::impulse, clip.style));
  EXPECT_EQ(of_styles.touched, impulses.touched);
  EXPECT_NEAR(of_styles.mean(), impulses.mean(), 1e-12);
  // What is asked to come early is compared with when it was asked for.
  EvaluationOptions early;
  early.sender.ahead = 0.1;
  const Evaluation sooner = evaluate(few_walks_model(), unseen_walks(), {}, early);
  EXPECT_EQ(sooner.contacts(Heard::impulse).missed, 0);
  EXPECT_NEAR(sooner.contacts(Heard::impulse).mean(), impulses.mean(), 0.02);
  // A network that holds frames back makes contacts late by what it takes in the mean.
  EvaluationOptions uneven;
  uneven.sender.jitter = 0.03;
  const Evaluation later_frames = evaluate(few_walks_model(), unseen_walks(), {}, uneven);
  EXPECT_NEAR(later_frames.contacts(Heard::impulse).mean() - impulses.mean(), 0.015, 0.01);
}

TEST(Evaluation, means_over_clips_and_frames_are_what_they_say) {
  const Evaluation& all = evaluation();
  double over_clips = 0, sum = 0, frames = 0;
  for (const EvaluatedClip& clip : all.clips) {
    double joints = 0, counted = 0;
    for (std::size_t i = 0; i < all.counted.size(); ++i)
      if (all.counted[i]) joints += clip.angle_sums[2][static_cast<Eigen::Index>(i)], ++counted;
    over_clips += joints / counted / clip.frames / static_cast<double>(all.clips.size());
    sum += joints / counted;
    frames += clip.frames;
  }
  EXPECT_NEAR(all.error(Estimate::mapped).over_clips, over_clips, 1e-12);
  EXPECT_NEAR(all.error(Estimate::mapped).pooled, sum / frames, 1e-12);
  int hips = 0;
  for (std::size_t i = 0; i < all.counted.size(); ++i) hips += !all.counted[i];
  EXPECT_EQ(hips, 1) << "the hips are not counted";
  EXPECT_GT(static_cast<double>(all.frame_microseconds.size()), frames)
      << "all frames of the clips are timed";
}

TEST(Evaluation, counts_styles_that_the_model_knows) {
  const Evaluation& all = evaluation();
  EXPECT_TRUE(all.clips[0].style_known);
  EXPECT_FALSE(all.clips[2].style_known) << "heavy was not taught";
  EXPECT_EQ(all.confusion.sum(), all.clips[0].frames + all.clips[1].frames);
  EXPECT_NEAR(all.style_accuracy().pooled,
              all.confusion.diagonal().sum() / static_cast<double>(all.confusion.sum()), 1e-12);
  EXPECT_GT(all.style_accuracy().over_clips, 0.8);
  EXPECT_EQ(all.style_accuracy_of_clips(), 1);
  EXPECT_TRUE(std::isnan(all.error(Estimate::mapped, "no such style").over_clips));
  EXPECT_GT(all.error(Estimate::mapped, "sad").over_clips, 0);
  EXPECT_GE(all.calibration_error, 0);
  EXPECT_LE(all.calibration_error, 1);
}

TEST(Evaluation, errors_are_those_of_a_sequence_played_by_hand) {
  const auto model = few_walks_model();
  PlaySettings settings;
  settings.decoder = DecoderKind::viterbi;
  const CorpusWalk walk = make_walk(plan_of("sad", 9));
  const Evaluation one = evaluate(model, {walk_of(walk)}, settings);
  const Sequence truth =
      walk_sequence(*model->body,
                    body_poses(walk.clip, *model->body,
                               match_joints(*model->body, walk.clip.skeleton, walk.clip.name), 1.1),
                    walk.contacts, walk.clip.name);
  const PlayedSequence played = play_sequence(model, settings, truth);
  int right = 0;
  double knee = 0;
  const int stream = 2;
  for (int frame = played.begin; frame < played.end; ++frame) {
    right += played.decisions[frame].label == played.true_label[frame];
    knee += stream_errors(*model, played.outputs.col(frame), truth.outputs.col(frame))[stream];
  }
  const double frames = played.end - played.begin;
  EXPECT_NEAR(one.step_accuracy().pooled, right / frames, 1e-12);
  EXPECT_NEAR(one.stream_error(Estimate::synthesised, stream).over_clips, knee / frames, 1e-9);
}

TEST(Evaluation, skips_clips_without_steps_and_says_so) {
  std::vector<Walk> walks = unseen_walks();
  walks[1].contacts.resize(2);
  const Evaluation some = evaluate(few_walks_model(), walks, {});
  EXPECT_EQ(some.clips.size(), 2u);
  ASSERT_EQ(some.skipped.size(), 1u);
  EXPECT_NE(some.skipped[0].find("found 1"), std::string::npos);
  EXPECT_THROW(evaluate(few_walks_model(), {walks[1]}, {}), Error);
}

TEST(Evaluation, delays_count) {
  PlaySettings settings;
  settings.future = 4;
  EXPECT_EQ(evaluate(few_walks_model(), {unseen_walks()[0]}, settings).delay_frames, 4);
}

}  // namespace
}  // namespace gait
