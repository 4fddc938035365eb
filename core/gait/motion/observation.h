// Observations: the vectors x of inputs, which a recogniser takes, and y of outputs, which a
// synthesiser learns (docs/design.md).
//
// x holds the values that move and their differences to some earlier frames; it is causal, so that
// learning and playing see the same. y holds the values that move and their centred first and
// second differences. Both are scaled by a mean and a deviation per dimension. Learning (double)
// and playing (float) share this code.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <type_traits>
#include <vector>

namespace gait {

// Which values of a frame are observed, and how far back.
struct InputLayout {
  int values = 0;             // how many values a frame of the input streams has
  std::vector<int> modelled;  // which of them move, ascending
  std::vector<int> lags;      // frames back, ascending, each at least 1
  // Deviations beyond which an entry of a scaled observation is clipped; infinite: none is.
  double clip = std::numeric_limits<double>::infinity();

  bool clips() const { return clip < std::numeric_limits<double>::max(); }
  int statics() const { return static_cast<int>(modelled.size()); }
  int size() const { return statics() * (1 + static_cast<int>(lags.size())); }
  // A difference over d frames speaks of the moment d/2 frames ago: how many frames ago all entries
  // of x speak of in the mean.
  double mean_age() const {
    return std::accumulate(lags.begin(), lags.end(), 0.0) /
           (2.0 * static_cast<double>(1 + lags.size()));
  }
  // Number of leading entries of x that are known when `past` frames came before this one: the
  // statics, and the differences to frames that exist.
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

// Per dimension of an observation: scaled = (raw - mean) / deviation, then clipped.
struct Scaling {
  Eigen::VectorXd mean, deviation;
};

// Clips a scaled observation, of which `known` leading entries are real: a sensor that moves more
// than it was taught to must not lead the others away. An entry beyond layout.clip deviations is
// held there. As the whole observation leaves what was taught (the root of its mean square grows
// above 2.5, about 1 having been taught and 2.4 being what people of another rig reach), the entry
// falls towards clip^4 / |entry|^3 instead, so that what deviates most counts least. True when
// there was anything to clip.
template <typename Vector>
bool clip_observation(const InputLayout& layout, int known, Vector&& x) noexcept {
  using Scalar = typename std::remove_cvref_t<Vector>::Scalar;
  if (!layout.clips()) return false;
  constexpr auto usual = static_cast<Scalar>(2.5 * 2.5);
  const auto clip = static_cast<Scalar>(layout.clip);
  if ((x.array().abs() <= clip).all()) return false;
  const Scalar square = x.head(known).squaredNorm() / static_cast<Scalar>(std::max(1, known));
  const Scalar far = square > usual ? 1 - usual / square : Scalar(0);
  for (Scalar& entry : x) {
    const Scalar size = std::abs(entry);
    if (!(size > clip)) continue;
    const Scalar ratio = clip / size, left = 1 - far * (1 - ratio * ratio * ratio);
    entry = std::copysign(clip * left, entry);
  }
  return true;
}

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
        raw_(Vector::Zero(layout.size())),
        unclipped_(raw_),
        scaled_(raw_) {
    history_.setZero();
  }

  // Takes a frame of layout.values values; what follows is then of this frame.
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
    unclipped_ = (raw_ - mean_).cwiseProduct(inverse_deviation_);
    known_ = layout_.known(past_);
    scaled_ = unclipped_;
    clipped_ = clip_observation(layout_, known_, scaled_);
    past_ = std::min(past_ + 1, static_cast<int>(history_.cols()) - 1);
  }

  const Vector& scaled() const noexcept { return scaled_; }
  const Vector& unclipped() const noexcept { return unclipped_; }  // scaled, but not clipped
  bool clipped() const noexcept { return clipped_; }               // whether these two differ
  const Vector& raw() const noexcept { return raw_; }
  int known() const noexcept { return known_; }  // leading entries that are known
  const InputLayout& layout() const noexcept { return layout_; }

  void reset() noexcept { past_ = 0, known_ = 0; }

 private:
  InputLayout layout_;
  Vector mean_, inverse_deviation_;
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> history_;  // ring of columns
  Vector raw_, unclipped_, scaled_;
  int newest_ = 0, past_ = 0, known_ = 0;
  bool clipped_ = false;
};

// The windows of first and second differences over neighbouring frames (T14 as in HTS).
inline constexpr double first_difference[3] = {-0.5, 0, 0.5};
inline constexpr double second_difference[3] = {1, -2, 1};

}  // namespace gait
