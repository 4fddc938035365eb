// A built-in walk as the messages that objects send each other, made by the core.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "patches/demo_model.h"
#include "play/synthesise/told_gaussians.h"

namespace gait::testing {

// Rows of a frame's streams.
struct WalkedStreams {
  Eigen::MatrixXf in, out, pose;
  int frames() const { return static_cast<int>(in.cols()); }
};

inline std::span<const float> column(const Eigen::MatrixXf& values, int frame) {
  return {values.col(frame).data(), static_cast<std::size_t>(values.rows())};
}

inline WalkedStreams walked_streams(const char* style, int take = 9) {
  const Body& body = *demo()->body;
  const Sequence streams = streams_of(make_walk(plan_of(style, take)), body);
  WalkedStreams result;
  result.in = streams.inputs.cast<float>();
  result.out = streams.outputs.cast<float>();
  result.pose.setZero(3 * body.skeleton.size(), result.in.cols());
  for (std::size_t i = 0; i < body.input_joints.size(); ++i)
    result.pose.middleRows(3 * body.input_joints[i], 3) =
        result.in.middleRows(3 * static_cast<Eigen::Index>(i), 3);
  for (std::size_t i = 0; i < body.output_joints.size(); ++i)
    result.pose.middleRows(3 * body.output_joints[i], 3) =
        result.out.middleRows(3 * static_cast<Eigen::Index>(i), 3);
  return result;
}

inline std::string gauss_message(const Told& told, int lag = 0) {
  std::vector<float> values{static_cast<float>(lag), static_cast<float>(told.means.size() / 3)};
  values.insert(values.end(), told.means.begin(), told.means.end());
  values.insert(values.end(), told.variances.begin(), told.variances.end());
  return message_of("gauss", values);
}

inline std::string place_message(const Told& told) {
  std::vector<float> values{told.phase, told.cadence};
  values.insert(values.end(), told.styles.begin(), told.styles.end());
  return message_of("place", values);
}

inline void expect_near(const std::vector<double>& sent, std::span<const float> computed,
                        double tolerance = 1e-6) {
  ASSERT_EQ(sent.size(), computed.size());
  for (std::size_t i = 0; i < sent.size(); ++i) EXPECT_NEAR(sent[i], computed[i], tolerance) << i;
}

}  // namespace gait::testing
