#include "gait/play/recognise/standing_detector.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace gait {

namespace {

constexpr double long_difference = 1.0 / 6;  // seconds, about
constexpr double window = 0.7;               // seconds
// Shares of the quietest style's activity. The least of a captured walk was 0.55 of its style's;
// one who stands with every joint swaying by nearly a degree shows 0.29 of the quietest's.
constexpr double standing_share = 0.32, walking_share = 0.43;
// A model of lively walks alone must know slower ones too.
constexpr double loudest_quietest = 0.35;

// How much the mean walk of the model's quietest style changes over its `lag`th difference, as a
// share of all training's.
double quietest_style(const Model& model, int lag, const Eigen::VectorXd& weight, double learnt) {
  const int statics = model.input.statics();
  const Eigen::Index first = statics * static_cast<Eigen::Index>(lag + 1);
  const auto mean = model.input_scaling.mean.segment(first, statics);
  const auto deviation = model.input_scaling.deviation.segment(first, statics);
  double quietest = loudest_quietest * loudest_quietest * learnt;
  for (std::size_t style = 0; style < model.styles.size(); ++style) {
    double sum = 0, seconds = 0;
    for (const Label& label : model.labels)
      for (const State& state : label.states) {
        const auto scaled = state.style_means.col(static_cast<Eigen::Index>(style));
        const Eigen::VectorXd change =
            mean + deviation.cwiseProduct(scaled.segment(first, statics));
        sum += state.duration * weight.dot(change.cwiseAbs2());
        seconds += state.duration;
      }
    if (seconds > 0) quietest = std::min(quietest, sum / seconds);
  }
  return std::sqrt(quietest / learnt);
}

}  // namespace

StandingDetector::StandingDetector(const Model& model)
    : modelled_(model.input.modelled),
      missing_(model.input.values, false),
      there_(Eigen::ArrayXi::Zero(static_cast<Eigen::Index>(modelled_.size()))),
      energies_(std::max(1, static_cast<int>(std::lround(window * model.frame_rate)))) {
  const std::vector<int>& lags = model.input.lags;
  if (!lags.empty()) {
    const double wanted = long_difference * model.frame_rate;
    const auto nearest = std::min_element(lags.begin(), lags.end(), [&](int a, int b) {
      return std::abs(a - wanted) < std::abs(b - wanted);
    });
    long_lag_ = *nearest;
    if (lags.front() < long_lag_) short_lag_ = lags.front();
    const auto statics = static_cast<Eigen::Index>(modelled_.size());
    const Eigen::VectorXd squares =
        model.input_scaling.deviation.segment(statics * (nearest - lags.begin() + 1), statics)
            .cwiseAbs2();
    // Radians may be added up; what streams of other units change is counted in deviations.
    const bool one_unit = std::ranges::all_of(
        model.inputs, [](const Stream& stream) { return stream.kind == StreamKind::rotation; });
    const Eigen::VectorXd weight =
        one_unit ? Eigen::VectorXd::Ones(statics) : Eigen::VectorXd(squares.cwiseInverse());
    weight_ = weight.cast<float>();
    learnt_ = weight.cwiseProduct(squares).cast<float>();
    const double quietest = quietest_style(model, static_cast<int>(nearest - lags.begin()), weight,
                                           weight.dot(squares));
    standing_below_ = static_cast<float>(standing_share * quietest);
    walking_above_ = static_cast<float>(walking_share * quietest);
    const float ratio = static_cast<float>(short_lag_) / static_cast<float>(long_lag_);
    slow_share_ = 1 - ratio * ratio;
  }
  history_ = Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(modelled_.size()), long_lag_ + 1);
  reset();
}

void StandingDetector::reset() noexcept {
  there_.setZero();
  newest_ = frames_ = 0;
  activity_ = 1;
  walking_ = true;
}

void StandingDetector::set_missing(int value, bool missing) noexcept { missing_[value] = missing; }

float StandingDetector::energy() const noexcept {
  const int columns = static_cast<int>(history_.cols());
  const auto back = [&](int frames) {
    return history_.col((newest_ - frames + columns) % columns).array();
  };
  const auto known = (there_ > long_lag_).cast<float>();
  const float learnt = (known * learnt_.array()).sum();
  if (!(learnt > 0)) return 0;
  float moved = (known * weight_.array() * (back(0) - back(long_lag_)).square()).sum();
  if (short_lag_ > 0)
    moved -= (known * weight_.array() * (back(0) - back(short_lag_)).square()).sum();
  return std::max(0.0f, moved / (slow_share_ * learnt));
}

bool StandingDetector::advance(std::span<const float> values) noexcept {
  if (long_lag_ == 0) return walking_;
  newest_ = (newest_ + 1) % static_cast<int>(history_.cols());
  bool any = false;
  for (std::size_t i = 0; i < modelled_.size(); ++i) {
    const int value = modelled_[i];
    const auto at = static_cast<Eigen::Index>(i);
    history_(at, newest_) = values[value];
    there_[at] = missing_[value] ? 0 : std::min(there_[at] + 1, long_lag_ + 1);
    any = any || there_[at] > long_lag_;
  }
  // Without a history, or without any input, nothing is known: it is as it was.
  if (!any) return walking_;
  const int size = static_cast<int>(energies_.size());
  energies_[frames_ % size] = energy();
  frames_ = frames_ + 1 < 2 * size ? frames_ + 1 : size;
  const int filled = std::min(frames_, size);
  float sum = 0;
  for (int i = 0; i < filled; ++i) sum += energies_[i];
  activity_ = std::sqrt(sum / static_cast<float>(filled));
  if (activity_ > walking_above_) walking_ = true;
  if (activity_ < standing_below_ && filled == size) walking_ = false;
  return walking_;
}

}  // namespace gait
