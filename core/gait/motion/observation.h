// Observations: what a recogniser sees of a frame, and what a synthesiser is taught
// (docs/design.md, Observe).
//
// Input observation x: the values that move, then their differences to some frames back; causal, so
// that learning sees what playing will see. Output observation y: the values that move with centred
// first and second differences. Both are scaled by a mean and a deviation per dimension. One code
// for learning (double) and playing (float).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <vector>

namespace gait {

// Which values of a frame are observed, and how far back.
struct InputLayout {
  int values = 0;             // how many values a frame of the input streams has
  std::vector<int> modelled;  // which of them move, ascending
  std::vector<int> lags;      // frames back, ascending, each at least 1

  int statics() const { return static_cast<int>(modelled.size()); }
  int size() const { return statics() * (1 + static_cast<int>(lags.size())); }
  // How many leading entries of x are real when `past` frames came before this one: the statics and
  // the differences whose frame back exists.
  int known(int past) const {
    const auto reached = std::upper_bound(lags.begin(), lags.end(), past) - lags.begin();
    return statics() * (1 + static_cast<int>(reached));
  }
};

struct OutputLayout {
  int values = 0;
  std::vector<int> modelled;

  int statics() const { return static_cast<int>(modelled.size()); }
  int size() const { return 3 * statics(); }  // statics, first differences, second differences
};

// Per dimension of an observation: scaled = (raw - mean) / deviation.
struct Scaling {
  Eigen::VectorXd mean, deviation;
};

// Turns a stream of frames into input observations. Never allocates after construction.
template <typename Scalar>
class InputObserver {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  InputObserver(const InputLayout& layout, const Scaling& scaling)
      : layout_(layout),
        mean_(scaling.mean.cast<Scalar>()),
        inverse_deviation_(scaling.deviation.cwiseInverse().cast<Scalar>()),
        history_(layout.statics(), (layout.lags.empty() ? 0 : layout.lags.back()) + 1),
        raw_(layout.size()),
        scaled_(layout.size()) {
    history_.setZero();
    raw_.setZero();
    scaled_.setZero();
  }

  // Takes a frame of layout.values values. Afterwards `scaled`, `raw` and `known` speak of it.
  void advance(std::span<const Scalar> values) noexcept {
    newest_ = (newest_ + 1) % static_cast<int>(history_.cols());
    for (int i = 0; i < layout_.statics(); ++i)
      history_(i, newest_) = values[static_cast<std::size_t>(layout_.modelled[i])];
    const int statics = layout_.statics();
    raw_.head(statics) = history_.col(newest_);
    for (std::size_t lag = 0; lag < layout_.lags.size(); ++lag) {
      const int back = std::min(layout_.lags[lag], past_);
      const int columns = static_cast<int>(history_.cols());
      raw_.segment(statics * static_cast<int>(lag + 1), statics) =
          history_.col(newest_) - history_.col((newest_ - back + columns) % columns);
    }
    scaled_ = (raw_ - mean_).cwiseProduct(inverse_deviation_);
    known_ = layout_.known(past_);
    past_ = std::min(past_ + 1, static_cast<int>(history_.cols()) - 1);
  }

  const Vector& scaled() const noexcept { return scaled_; }
  const Vector& raw() const noexcept { return raw_; }
  int known() const noexcept { return known_; }  // leading entries whose history is real
  const InputLayout& layout() const noexcept { return layout_; }

  void reset() noexcept { past_ = 0, known_ = 0; }

 private:
  InputLayout layout_;
  Vector mean_, inverse_deviation_;
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> history_;  // ring of columns
  Vector raw_, scaled_;
  int newest_ = 0, past_ = 0, known_ = 0;
};

// The windows of first and second differences over neighbouring frames (T14 as in HTS).
inline constexpr double first_difference[3] = {-0.5, 0, 0.5};
inline constexpr double second_difference[3] = {1, -2, 1};

}  // namespace gait
