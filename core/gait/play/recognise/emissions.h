// Emissions: the log-likelihood of an input observation in every state, from as much of it as is
// known.
#pragma once

#include <memory>
#include <span>

#include "gait/play/recognise/state_tables.h"

namespace gait {

// Whitens observations: e = L^-1 (x - mu_x). Scratch space for one user at a time.
class Whitening {
 public:
  explicit Whitening(int inputs);

  // Picks the entries of `x` (scaled, model.input.size() entries) that the tables keep.
  void take(const StateTables& tables, const Eigen::Ref<const Eigen::VectorXf>& x) noexcept;
  // The leading `count` entries of the state's innovation; valid until the next call.
  Eigen::Map<const Eigen::VectorXf> innovation(const PlayedState& state, int count) noexcept;
  // Mahalanobis distance of as many entries from the state's mean, by the root of their number.
  float distance(const PlayedState& state, int count) noexcept;
  // The kept entries of the observation taken, with room for whole panels.
  const Eigen::VectorXf& kept() const noexcept { return kept_; }

 private:
  Eigen::VectorXf kept_, innovation_;
};

class Emissions {
 public:
  Emissions(std::shared_ptr<const StateTables> tables, const InputLayout& layout);

  // `x`: scaled observation; `known`: leading entries whose history is real. One log-likelihood per
  // state, over all labels.
  std::span<const float> of(const Eigen::Ref<const Eigen::VectorXf>& x, int known) noexcept;

  // Of that observation: its squared Mahalanobis distance from each state's mean, and over how many
  // entries.
  const Eigen::VectorXf& squared_distances() const noexcept { return squared_distances_; }
  int seen() const noexcept { return seen_; }
  // And its innovation in a state, of so many entries.
  Eigen::Map<const Eigen::VectorXf> innovation(int state) const noexcept {
    return {innovations_.col(state).data(), seen_};
  }

  void use(const std::shared_ptr<const StateTables>& tables) noexcept { tables_ = tables; }

 private:
  std::shared_ptr<const StateTables> tables_;
  InputLayout layout_;
  Whitening whitening_;
  std::vector<float> log_likelihoods_;
  Eigen::VectorXf squared_distances_;
  Eigen::MatrixXf innovations_;  // a column per state
  int seen_ = 0;
};

}  // namespace gait
