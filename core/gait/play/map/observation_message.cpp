#include "gait/play/map/observation_message.h"

#include <algorithm>
#include <cmath>

namespace gait {

namespace {

// Takes numbers off the front of a row.
class Row {
 public:
  explicit Row(std::span<const float> numbers) : left_(numbers) {}

  std::size_t left() const { return left_.size(); }
  float number() {
    const float first = left_.front();
    left_ = left_.subspan(1);
    return first;
  }
  // Whether a whole number from 0 to `most` comes next; then it is taken into `value`.
  bool whole(int most, int& value) {
    if (left_.empty()) return false;
    const float next = left_.front();
    if (!(next >= 0 && next <= static_cast<float>(most)) || next != std::floor(next)) return false;
    value = static_cast<int>(number());
    return true;
  }

 private:
  std::span<const float> left_;
};

constexpr int longest_lag = 100000;  // frames; beyond, it is no lag

}  // namespace

ObservationMessage::ObservationMessage(const Model& model)
    : layout_(model.input),
      model_states_(model.states()),
      row_(4 + 2 * Decoder::most_weighted + layout_.values + layout_.size()),
      states_(Decoder::most_weighted),
      missing_(layout_.values),
      observation_(layout_.size()) {}

std::span<const float> ObservationMessage::write(const Recogniser& recogniser) noexcept {
  auto next = row_.begin();
  const auto put = [&](auto value) { *next++ = static_cast<float>(value); };
  put(recogniser.lag());
  put(recogniser.states().size());
  for (const WeightedState& state : recogniser.states()) put(state.state), put(state.weight);
  put(recogniser.missing().size());
  for (const int value : recogniser.missing()) put(value);
  put(recogniser.known());
  next = std::copy_n(recogniser.observation().data(), recogniser.known(), next);
  return {row_.begin(), next};
}

const char* ObservationMessage::read(std::span<const float> numbers) noexcept {
  // Looked through whole before anything is kept.
  for (const bool keep : {false, true}) {
    Row row(numbers);
    int lag = 0, states = 0, missing = 0, known = 0, index = 0;
    if (!row.whole(longest_lag, lag)) return "expected a lag in frames first";
    if (!row.whole(Decoder::most_weighted, states) || states == 0)
      return "expected the number of states, 1 to 8, after the lag";
    float total = 0;
    for (int i = 0; i < states; ++i) {
      if (!row.whole(model_states_ - 1, index) || row.left() == 0)
        return "expected states of this model, each with its weight";
      const float weight = row.number();
      if (!(weight >= 0) || !std::isfinite(weight)) return "expected weights of 0 or more";
      total += weight;
      if (keep) states_[i] = {index, weight};
    }
    if (!(total > 0)) return "expected weights that are not all 0";
    if (!row.whole(layout_.values, missing))
      return "expected the number of missing input values after the states";
    for (int i = 0; i < missing; ++i) {
      if (!row.whole(layout_.values - 1, index)) return "expected missing input values by index";
      if (keep) missing_[i] = index;
    }
    if (!row.whole(layout_.size(), known) || known == 0 || known % layout_.statics() != 0)
      return "expected an observation of this model: statics, then whole sets of differences";
    if (row.left() != static_cast<std::size_t>(known))
      return "expected as many entries of the observation as the number before them says";
    for (int i = 0; i < known; ++i) {
      const float entry = row.number();
      if (!std::isfinite(entry)) return "expected entries of the observation that are finite";
      if (keep) observation_[i] = entry;
    }
    if (!keep) continue;
    lag_ = lag, state_count_ = states, missing_count_ = missing, known_ = known;
  }
  return nullptr;
}

}  // namespace gait
