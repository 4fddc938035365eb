#include "gait/play/synthesise/step_gaussian.h"

#include <algorithm>

namespace gait {

namespace {

// Slower than this the weights of differences no longer grow: who stands would never arrive.
constexpr float slowest_rate = 0.3f;

}  // namespace

StepGaussian::StepGaussian(std::shared_ptr<const StepTables> tables, float period)
    : tables_(std::move(tables)),
      period_(period),
      gaussian_{Eigen::VectorXf::Zero(3 * tables_->values),
                Eigen::VectorXf::Ones(3 * tables_->values)},
      rates_(Eigen::VectorXf::Zero(tables_->styles)),
      shares_(rates_) {}

// Half-way between two states' centres the Gaussian is half the one and half the other.
const OutputGaussian& StepGaussian::at(const Moment& moment,
                                       const Eigen::VectorXf& weights) noexcept {
  const auto first_of = [&](int label) {
    return static_cast<std::size_t>(tables_->first_state[label]);
  };
  const auto centre = [&](std::size_t state) { return tables_->states[state].centre; };
  const std::size_t first = first_of(moment.label), last = first_of(moment.label + 1) - 1;
  float now = moment.progress;
  rates_.setZero();
  if (moment.duration > 0) {
    // A state's mean is that of frames that begin within it: half a frame before its centre.
    now += 0.5f * period_ / moment.duration;
    rates_ = tables_->durations.row(moment.label).transpose() / moment.duration;
  }

  std::size_t a = first, b = first;
  float from = centre(a), to = from;
  if (now < from) {
    if (moment.before >= 0) {
      a = first_of(moment.before + 1) - 1;
      from = centre(a) - 1;
    }
  } else {
    while (a < last && centre(a + 1) <= now) ++a;
    from = to = centre(a);
    b = a;
    if (a < last) {
      b = a + 1;
      to = centre(b);
    } else if (moment.next >= 0) {
      b = first_of(moment.next);
      to = 1 + centre(b);
    }
  }
  const float way = to > from ? (now - from) / (to - from) : 0.0f;
  gaussian_.mean.setZero();
  gaussian_.variance.setZero();
  add(a, 1 - way, weights);
  if (b != a && way > 0) add(b, way, weights);
  return gaussian_;
}

// Differences per frame grow with the speed at which the states are walked through.
void StepGaussian::add(std::size_t index, float share, const Eigen::VectorXf& weights) noexcept {
  const WalkedState& state = tables_->states[index];
  const Eigen::Index values = tables_->values;
  const float rate = std::max(slowest_rate, rates_.dot(weights));
  shares_ = share * weights;
  for (Eigen::Index part = 0; part < 3; ++part) {
    gaussian_.mean.segment(part * values, values).noalias() +=
        state.means.middleRows(part * values, values) * shares_;
    gaussian_.variance.segment(part * values, values) +=
        share * state.variances.segment(part * values, values);
    shares_.array() *= rates_.array();
    share *= rate * rate;
  }
}

}  // namespace gait
