#include "gait/play/map/observation_map.h"

#include <algorithm>
#include <cmath>

namespace gait {

namespace {

constexpr float strongest = 10, widest = 1000;

bool is_strength(float strength) noexcept { return std::abs(strength) <= strongest; }

}  // namespace

ObservationMap::ObservationMap(const PlayModel& played)
    : model_(played.model),
      tables_(played.states()),
      map_(*model_, tables_),
      maker_(model_),
      scaling_mean_(model_->input_scaling.mean.cast<float>()),
      inverse_deviation_(model_->input_scaling.deviation.cwiseInverse().cast<float>()),
      scaled_(Eigen::VectorXf::Zero(model_->input.size())),
      streams_(StreamLayout::of_outputs(*model_)),
      strengths_(model_->outputs.size(), static_cast<float>(model_->play.strength)),
      bias_(model_->output.values, 0.0f),
      unmodelled_(model_->output.values),
      wanted_(model_->input.values, false),
      masked_(wanted_),
      mean_(3 * model_->output.values, 0.0f),
      variance_(mean_) {
  Eigen::Map<Eigen::VectorXf>(unmodelled_.data(), model_->output.values) =
      model_->output_mean.cast<float>();
}

void ObservationMap::keep_tables_current(std::span<const int> missing) noexcept {
  if (maker_.finished()) {
    if (const auto fresh = maker_.ready()) map_.use(fresh);
    maker_.take(tables_);
    awaiting_ = false;
  }
  std::fill(wanted_.begin(), wanted_.end(), false);
  for (const int value : missing) wanted_[value] = true;
  if (wanted_ != masked_ && maker_.ask(wanted_)) {
    awaiting_ = true;
    std::copy(wanted_.begin(), wanted_.end(), masked_.begin());
  }
}

void ObservationMap::map(std::span<const WeightedState> states, std::span<const int> missing,
                         std::span<const float> observation) noexcept {
  keep_tables_current(missing);
  // As InputObserver scales it.
  const auto known = static_cast<Eigen::Index>(observation.size());
  const Eigen::Map<const Eigen::VectorXf> raw(observation.data(), known);
  scaled_.head(known) =
      (raw - scaling_mean_.head(known)).cwiseProduct(inverse_deviation_.head(known));
  scatter(map_.map(states, scaled_, static_cast<int>(known)));
}

void ObservationMap::map(const Recogniser& decided) noexcept { scatter(map_.map(decided)); }

// Over all output values, those that the model moves where they lie.
void ObservationMap::scatter(const OutputGaussian& gaussian) noexcept {
  const int values = model_->output.values, statics = model_->output.statics();
  std::fill(mean_.begin(), mean_.end(), 0.0f);
  std::fill(variance_.begin(), variance_.end(), 0.0f);
  std::copy(unmodelled_.begin(), unmodelled_.end(), mean_.begin());
  for (int part = 0; part < 3; ++part)
    for (int i = 0; i < statics; ++i) {
      const int value = part * values + model_->output.modelled[i];
      mean_[value] = gaussian.mean[part * statics + i];
      variance_[value] = spread_ * gaussian.variance[part * statics + i];
    }
  for (int value = 0; value < values; ++value) mean_[value] += bias_[value];
}

bool ObservationMap::set_strength(float strength) noexcept {
  if (!is_strength(strength)) return false;
  map_.set_strength(strength);
  std::ranges::fill(strengths_, strength);
  return true;
}

bool ObservationMap::set_strength(int stream, float strength) noexcept {
  if (!streams_.has(stream) || !is_strength(strength)) return false;
  strengths_[stream] = strength;
  const StreamPlace& place = streams_[stream];
  const std::vector<int>& modelled = model_->output.modelled;
  for (std::size_t i = 0; i < modelled.size(); ++i)
    if (modelled[i] >= place.begin && modelled[i] < place.begin + place.size)
      map_.set_strength(static_cast<int>(i), strength);
  return true;
}

bool ObservationMap::set_bias(int stream, std::span<const float> bias) noexcept {
  if (!streams_.fits(stream, bias)) return false;
  std::copy(bias.begin(), bias.end(), bias_.begin() + streams_[stream].begin);
  return true;
}

bool ObservationMap::set_spread(float spread) noexcept {
  if (!(spread > 0 && spread <= widest)) return false;
  spread_ = spread;
  return true;
}

std::span<const float> ObservationMap::bias(int stream) const noexcept {
  return {bias_.data() + streams_[stream].begin, static_cast<std::size_t>(streams_[stream].size)};
}

}  // namespace gait
