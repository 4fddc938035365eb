// Streams played frame by frame, and what came out.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "gait/play/stream_reconstructor.h"
#include "play/few_walks.h"

namespace gait::testing {

struct Played {
  std::vector<std::vector<float>> outputs;
  std::vector<Decision> decisions;
  std::vector<std::vector<float>> styles;

  void collect(const ReconstructedFrame& frame) {
    outputs.emplace_back(frame.outputs.begin(), frame.outputs.end());
    decisions.push_back(frame.decision);
    styles.emplace_back(frame.styles.begin(), frame.styles.end());
  }
};

inline std::span<const float> frame_of(const Eigen::MatrixXf& inputs, int frame) {
  return {inputs.col(frame).data(), static_cast<std::size_t>(inputs.rows())};
}

inline Played play_through(StreamReconstructor& reconstructor, const Eigen::MatrixXf& inputs) {
  Played played;
  for (int frame = 0; frame < inputs.cols(); ++frame)
    if (reconstructor.advance(frame_of(inputs, frame))) played.collect(reconstructor.frame());
  while (reconstructor.flush()) played.collect(reconstructor.frame());
  return played;
}

// A walk that few_walks_model has not seen.
inline Eigen::MatrixXf held_out_inputs(const char* style = "sad") {
  const CorpusWalk walk = make_walk(plan_of(style, 9));
  return streams_of(walk, *few_walks_model()->body).inputs.cast<float>();
}

inline float largest_difference(std::span<const float> a, std::span<const float> b) {
  float largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace gait::testing
