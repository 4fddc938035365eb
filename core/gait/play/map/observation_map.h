// Observation map (T14 §4.2): an observation with its states in, a Gaussian over all output values
// out, with a hand on strength, place and spread.
//
// It remembers nothing from frame to frame but its settings, and the tables for the inputs that are
// there: when those change, new tables are made by a worker and until then the old ones serve.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "gait/model/stream_layout.h"
#include "gait/play/map/covariance_map.h"
#include "gait/play/play_model.h"
#include "gait/play/recognise/recogniser.h"
#include "gait/play/recognise/table_maker.h"

namespace gait {

class ObservationMap {
 public:
  // Throws Error when the model cannot be played.
  explicit ObservationMap(const PlayModel& played);

  // Maps one frame. `states`: of the model, weights 0 or more and not all 0; `missing`: input
  // values by index; `observation`: its leading entries that are real, in the streams' own units.
  // Sizes as ObservationMessage checks them.
  void map(std::span<const WeightedState> states, std::span<const int> missing,
           std::span<const float> observation) noexcept;

  // The same of what a recogniser of this very model decided on last, by its tables: no message
  // lies between them, and no tables are awaited. A map takes one way or the other.
  void map(const Recogniser& decided) noexcept;

  // 3 * model.output.values each: statics, first differences (per frame), second differences.
  // Values that are not modelled: their mean, no change, and variance 0.
  std::span<const float> mean() const noexcept { return mean_; }
  std::span<const float> variance() const noexcept { return variance_; }
  // Of the last observation from its states' means; about 1 for what was taught.
  float distance() const noexcept { return map_.distance(); }

  // Each is false, with nothing changed, when there is no such output stream, a number is not
  // finite or out of its range. 0 the average walk, 1 the paper's mapping, above 1 a caricature;
  // -10 to 10. For all, or for one output stream (a joint).
  bool set_strength(float strength) noexcept;
  bool set_strength(int stream, float strength) noexcept;
  // Added to the stream's static means; one number per value of the stream, in its unit.
  bool set_bias(int stream, std::span<const float> bias) noexcept;
  // Factor on all variances, above 0, to 1000.
  bool set_spread(float spread) noexcept;

  int streams() const noexcept { return streams_.streams(); }
  float strength(int stream) const noexcept { return strengths_[stream]; }
  std::span<const float> bias(int stream) const noexcept;
  float spread() const noexcept { return spread_; }

  // False while tables for other inputs are awaited.
  bool settled() const noexcept { return !awaiting_ && wanted_ == masked_; }
  const Model& model() const noexcept { return *model_; }

 private:
  void scatter(const OutputGaussian& gaussian) noexcept;
  void keep_tables_current(std::span<const int> missing) noexcept;

  std::shared_ptr<const Model> model_;
  std::shared_ptr<const StateTables> tables_;
  CovarianceMap map_;
  TableMaker maker_;
  Eigen::VectorXf scaling_mean_, inverse_deviation_, scaled_;
  StreamLayout streams_;           // of outputs
  std::vector<float> strengths_;   // per output stream
  std::vector<float> bias_;        // per output value
  std::vector<float> unmodelled_;  // what values that are not modelled are, per output value
  float spread_ = 1;
  std::vector<bool> wanted_, masked_;
  bool awaiting_ = false;
  std::vector<float> mean_, variance_;
};

}  // namespace gait
