// What playing computes with: each state's Gaussian, factored for the inputs that are there.
//
// With Sigma_xx = L L^T the whitened innovation e = L^-1 (x - mu_x) gives both the log-likelihood,
// from |e|^2, and the mapping (T14 §4.2): K (x - mu_x) = G e with G = Sigma_yx L^-T. Leading
// entries of e depend on leading entries of x alone, so an observation whose history is not real
// yet is decoded exactly from its leading part, without another factorisation. A change of the set
// of inputs needs new tables: they are made on a worker and swapped in.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "gait/model/model.h"
#include "gait/play/recognise/packed_map.h"

namespace gait {

struct PlayedState {
  int label = 0;
  PackedMap whitener;                            // e = L^-1 x - L^-1 mu_x, of the kept entries
  Eigen::VectorXf log_constant;                  // per depth
  PackedMap gain;                                // G e: y by kept entries, scaled
  Eigen::VectorXf output_mean, output_variance;  // of y, scaled
  Eigen::MatrixXf explained_variance;            // diagonal of G G^T, y by depth
  std::vector<PackedMap> style_scores;           // per depth: w^T x + b, styles by kept entries
  // The phase that a frame of the state speaks of is phase + phase_gain . e, in cycles; no gain in
  // models that do not say.
  float phase = 0;
  Eigen::VectorXf phase_gain;
  float log_stay = 0, log_leave = 0;
  float mean_duration = 0;  // seconds
  float before = 0;         // mean durations of the label's states before this, seconds
};

struct StateTables {
  std::vector<int> kept;    // entries of x that are there, ascending
  std::vector<int> depths;  // how many kept entries are known: statics, then one lag more each
  int outputs = 0;          // entries of y
  int styles = 0;
  std::vector<PlayedState> states;  // label after label
  std::vector<int> first_state;     // per label
  std::vector<std::vector<int>> successors;
  std::vector<float> label_duration;  // seconds

  int labels() const { return static_cast<int>(first_state.size()); }
  // The depth at which `known` leading entries of x are real.
  int depth_of(int known, const InputLayout& layout) const;
};

// `missing`: one per input value, true when it is not measured; empty: all are. Throws Error when
// nothing is left to see, or a covariance is not positive definite.
std::shared_ptr<const StateTables> make_state_tables(const Model& model,
                                                     const std::vector<bool>& missing = {});

}  // namespace gait
