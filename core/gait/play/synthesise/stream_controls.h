// Controls of single streams while they play: each can be scaled about its mean, shifted, or fixed.
//
// A stream is a joint's rotation vector (radians) or plain values in their own unit. Changes arrive
// within about a step. Nothing allocates after construction.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "gait/model/stream_layout.h"
#include "gait/play/change/glide.h"

namespace gait {

class StreamControls {
 public:
  explicit StreamControls(const StreamLayout& layout);

  // False, with nothing changed, when there is no such stream, the size is another or a number is
  // not finite.
  bool set_scale(int stream, float scale) noexcept;  // 1: as it is; -10 to 10
  bool set_shift(int stream, std::span<const float> by) noexcept;
  bool fix(int stream, std::span<const float> at) noexcept;
  bool free(int stream) noexcept;  // from all three

  void advance(float steps) noexcept;
  void arrive() noexcept;
  // Changes `values` (of all streams), whose means are `means`.
  void apply(const Eigen::VectorXf& means, Eigen::Ref<Eigen::VectorXf> values) const noexcept;

  void take_over(const StreamControls& other) noexcept;  // settings; the same streams

 private:
  struct Control {
    Glide scale{1}, fixed{0};
  };
  void note_rest() noexcept;

  StreamLayout layout_;
  std::vector<Control> controls_;       // per stream
  std::vector<Glide> shifts_, places_;  // per value
  bool at_rest_ = true;                 // every control has arrived
  bool neutral_ = true;                 // and leaves the values as they are
};

}  // namespace gait
