#include "gait/judge/played_sequence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gait/motion/rotation.h"
#include "play/few_walks.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::plan_of;
using testing::streams_of;

TEST(PlayedSequence, has_every_frame_and_the_truth_beside_it) {
  const auto model = few_walks_model();
  const CorpusWalk walk = make_walk(plan_of("sad", 9));
  const Sequence sequence = streams_of(walk, *model->body);
  for (const int future : {0, 4}) {
    PlaySettings settings;
    settings.future = future;
    const PlayedSequence played = play_sequence(model, settings, sequence);
    EXPECT_EQ(played.outputs.cols(), sequence.inputs.cols());
    EXPECT_EQ(static_cast<Eigen::Index>(played.decisions.size()), sequence.inputs.cols());
    EXPECT_TRUE(played.outputs.allFinite());
    EXPECT_EQ(played.begin, walk.contacts.front().frame);
    EXPECT_EQ(played.end, walk.contacts.back().frame);
    int right = 0;
    for (int frame = 0; frame < walk.clip.frames(); ++frame) {
      const bool inside = frame >= played.begin && frame < played.end;
      ASSERT_EQ(played.true_label[frame] >= 0, inside);
      if (!inside) continue;
      EXPECT_EQ(played.true_label[frame], walk.phase[frame] < 0.5 ? 0 : 1);
      right += played.decisions[frame].label == played.true_label[frame];
    }
    EXPECT_GT(right, 0.9 * (played.end - played.begin));
    for (Eigen::Index frame = 0; frame < played.style_posteriors.cols(); ++frame)
      EXPECT_NEAR(played.style_posteriors.col(frame).sum(), 1, 1e-5);
  }
}

TEST(PlayedSequence, with_delay_is_realigned) {
  const auto model = few_walks_model();
  const Sequence sequence = streams_of(make_walk(plan_of("proud", 9)), *model->body);
  const auto error = [&](int future, int shift) {
    PlaySettings settings;
    settings.future = future;
    const PlayedSequence played = play_sequence(model, settings, sequence);
    return (played.outputs.middleCols(30, 60) - sequence.outputs.middleCols(30 + shift, 60)).norm();
  };
  for (const int future : {0, 5}) {
    EXPECT_LT(error(future, 0), error(future, 3));
    EXPECT_LT(error(future, 0), error(future, -3));
  }
}

TEST(PlayedSequence, of_many_lengths_down_to_none_is_as_long) {
  const auto model = few_walks_model();
  const Sequence whole = streams_of(make_walk(plan_of("sad", 9)), *model->body);
  PlaySettings settings;
  settings.decoder = DecoderKind::lag;
  settings.lag = 0.2;
  settings.future = 3;
  for (const int frames : {0, 1, 5, 9, 10, 30}) {
    Sequence brief = whole;
    brief.segments.clear();
    brief.inputs = Eigen::MatrixXd(whole.inputs.leftCols(frames));
    const PlayedSequence played = play_sequence(model, settings, brief);
    EXPECT_EQ(static_cast<int>(played.decisions.size()), frames);
    EXPECT_EQ(played.begin, played.end);
  }
}

TEST(StreamErrors, are_angles_of_rotations_and_differences_of_plain_values) {
  Model model;
  model.outputs = {{"knee", 3, StreamKind::rotation}, {"light", 2, StreamKind::plain}};
  Eigen::VectorXd a(5), b(5);
  a << 0.3, -0.2, 0.5, 1, 2;
  b << -0.1, 0.4, 0.2, 1.5, 1;
  const Eigen::VectorXd errors = stream_errors(model, a, b);
  const Eigen::AngleAxisd between(
      Eigen::Quaterniond(Eigen::AngleAxisd(a.head<3>().norm(), a.head<3>().normalized()))
          .conjugate() *
      Eigen::Quaterniond(Eigen::AngleAxisd(b.head<3>().norm(), b.head<3>().normalized())));
  EXPECT_NEAR(errors[0], between.angle(), 1e-12);
  EXPECT_NEAR(errors[1], 0.75, 1e-12);
  // A whole turn is no error.
  a.head<3>() = Eigen::Vector3d(0, 0, 1);
  b.head<3>() = Eigen::Vector3d(0, 0, 1 - 2 * M_PI);
  EXPECT_NEAR(stream_errors(model, a, b)[0], 0, 1e-9);
}

}  // namespace
}  // namespace gait
