// Sequences of random observations with labels, for tests that compute.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "gait/learn/sequence.h"

namespace gait::testing {

// Segments of the given lengths with the labels in turn; x and y are noise about a mean that moves
// through each segment, so that states have something to find.
inline ObservedSequence random_sequence(const std::vector<int>& lengths, int labels, int inputs,
                                        int outputs, unsigned seed, int margin = 0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  ObservedSequence sequence;
  sequence.name = "sequence " + std::to_string(seed);
  sequence.source = static_cast<int>(seed);
  int frames = margin;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    sequence.segments.push_back({frames, frames + lengths[i], static_cast<int>(i) % labels});
    frames += lengths[i];
  }
  frames += margin;
  const auto noise = [&] { return normal(random); };
  sequence.x = Eigen::MatrixXd::NullaryExpr(inputs, frames, noise);
  sequence.y = Eigen::MatrixXd::NullaryExpr(outputs, frames, noise);
  for (const Segment& segment : sequence.segments)
    for (int frame = segment.begin; frame < segment.end; ++frame) {
      const double through = static_cast<double>(frame - segment.begin) /
                             static_cast<double>(segment.end - segment.begin);
      for (int i = 0; i < inputs; ++i)
        sequence.x(i, frame) += 2 * std::sin(3 * through + 2 * segment.label + i);
      for (int i = 0; i < outputs; ++i)
        sequence.y(i, frame) += 2 * std::cos(3 * through + segment.label + i);
    }
  return sequence;
}

// Several with segments of 6 to 14 frames and two styles in turn.
inline std::vector<ObservedSequence> random_sequences(int count, int segments, int inputs,
                                                      int outputs, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> length(6, 14);
  std::vector<ObservedSequence> sequences;
  for (int i = 0; i < count; ++i) {
    std::vector<int> lengths;
    for (int k = 0; k < segments; ++k) lengths.push_back(length(random));
    sequences.push_back(random_sequence(lengths, 2, inputs, outputs, seed + 100 + i, 3));
    sequences.back().style = i % 2;
  }
  return sequences;
}

}  // namespace gait::testing
