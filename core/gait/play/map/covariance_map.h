// Covariance mapping (T14 §4.2, Hueber et al. 2012): the style of the input, seen as its distance
// from the state's mean, carried over to the output.
//
//   mean      mu_y + s K (x - mu_x)          K = Sigma_yx Sigma_xx^-1
//   variance  diag(Sigma_yy - s (2 - s) K Sigma_xy)
//
// Strength s: 0 the average walk, 1 the paper's mapping, above 1 a caricature. Of several weighted
// states: the moments of the mixture. In a state from which the observation is further than is to
// be trusted (PlayDefaults::trust), s falls with the square of the distance.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "gait/play/output_gaussian.h"
#include "gait/play/recognise/decoder.h"
#include "gait/play/recognise/emissions.h"
#include "gait/play/recognise/recogniser.h"

namespace gait {

class CovarianceMap {
 public:
  CovarianceMap(const Model& model, std::shared_ptr<const StateTables> tables);

  // `strength`: one for all, or per modelled output value (outputs' statics).
  void set_strength(float strength) noexcept;
  void set_strength(int value, float strength) noexcept;
  float strength(int value) const noexcept { return strength_[value]; }

  // Maps the scaled observation `x`, of which `known` leading entries are real, in the states
  // given. It need not be clipped yet.
  const OutputGaussian& map(std::span<const WeightedState> states,
                            const Eigen::Ref<const Eigen::VectorXf>& x, int known) noexcept;

  // The same of what a recogniser decided on last, by its tables.
  const OutputGaussian& map(const Recogniser& decided) noexcept;

  // Mahalanobis distance of the last observation from its states' means, by the root of the number
  // of dimensions: about 1 for what was taught.
  float distance() const noexcept { return distance_; }

  void use(const std::shared_ptr<const StateTables>& tables) noexcept { tables_ = tables; }

 private:
  // `distances`: per state, where they are not those of the innovations.
  template <class InnovationOf>
  const OutputGaussian& mix(std::span<const WeightedState> states, int depth,
                            const float* distances, InnovationOf innovation_of) noexcept;

  std::shared_ptr<const StateTables> tables_;
  InputLayout layout_;
  Whitening whitening_;
  Eigen::VectorXf clipped_;
  std::vector<float> distances_;    // per state given
  Eigen::VectorXf scale_, offset_;  // from scaled y to the outputs' units
  int statics_;
  float trusted_;             // distance up to which the mapping has its full strength
  Eigen::VectorXf strength_;  // per entry of y
  Eigen::VectorXf shift_, mean_, squares_, variance_;  // scratch over y
  OutputGaussian mapped_;
  float distance_ = 0;
};

}  // namespace gait
