// Patches with [gait.viterbi~] and [gait.map] on one cord, frames to play in them, and what the
// core makes of the same frames.
#pragma once

#include <unistd.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "gait/play/map/covariance_map.h"
#include "gait/play/recognise/recogniser.h"
#include "patches/demo_model.h"
#include "patches/patch.h"
#include "play/few_walks.h"

namespace gait::testing {

inline CorpusWalk unseen_walk(const std::string& style, int cycles = 5) {
  return make_walk(plan_of(style, 55, cycles));
}
inline Eigen::MatrixXf inputs_of(const CorpusWalk& walk) {
  return streams_of(walk, *demo()->body).inputs.cast<float>();
}

inline std::string message_of(const std::string& selector, const Eigen::VectorXf& values) {
  return message_of(selector,
                    std::span<const float>(values.data(), static_cast<std::size_t>(values.size())));
}

// A patch with the model there at once, and the two objects on one cord.
struct ChainPatch : Patch {
  int viterbi, map;
  explicit ChainPatch(const std::string& flags = "") {
    object("gait.model gait-demo -blocking");
    viterbi = object("gait.viterbi~ gait-demo" + flags);
    map = object("gait.map gait-demo");
    connect(viterbi, 4, map);
    record(viterbi, 4, "cord");
    record(viterbi, 5, "info");
    record(map, 0, "gauss");
    record(map, 1, "distance");
  }
  // Plays frames in Pd's time, each with the seconds after the one before.
  void play(const std::vector<std::pair<double, std::string>>& messages) {
    static int count = 0;
    const std::string file = ::testing::TempDir() + "gait_frames_" + std::to_string(getpid()) +
                             "_" + std::to_string(count++) + ".txt";
    std::ofstream text(file);
    for (const auto& [seconds, message] : messages)
      text << 1000 * seconds << " frames " << message << ";\n";
    connect(object("r frames"), 0, viterbi);
    const int player = object("qlist"), begin = object("loadbang"), read = message("read " + file),
              start = message("bang");
    connect(begin, 0, read);
    connect(begin, 0, start);
    connect(read, 0, player);
    connect(start, 0, player);
  }
};

// What the recogniser and map of the core make of the same frames.
struct Computed {
  std::vector<std::vector<float>> gauss, styles;
  std::vector<Decision> decisions;
};

inline Computed computed(const Eigen::MatrixXf& inputs, float strength) {
  Computed result;
  Recogniser recogniser(demo());
  CovarianceMap map(*demo(), recogniser.tables());
  map.set_strength(strength);
  const OutputLayout& output = demo()->output;
  for (int frame = 0; frame < inputs.cols(); ++frame) {
    recogniser.advance({inputs.col(frame).data(), static_cast<std::size_t>(inputs.rows())});
    const OutputGaussian& gaussian =
        map.map(recogniser.states(), recogniser.unclipped(), recogniser.known());
    std::vector<float> row(2 + 6 * output.values, 0.0f);
    row[0] = 0, row[1] = static_cast<float>(output.values);
    for (int value = 0; value < output.values; ++value)
      row[2 + value] = static_cast<float>(demo()->output_mean[value]);
    for (int part = 0; part < 3; ++part)
      for (int i = 0; i < output.statics(); ++i) {
        const int value = part * output.values + output.modelled[i];
        row[2 + value] = gaussian.mean[part * output.statics() + i];
        row[2 + 3 * output.values + value] = gaussian.variance[part * output.statics() + i];
      }
    result.gauss.push_back(row);
    result.styles.emplace_back(recogniser.styles().begin(), recogniser.styles().end());
    result.decisions.push_back(recogniser.decision());
  }
  return result;
}

}  // namespace gait::testing
