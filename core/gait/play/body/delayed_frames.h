// Delays a measured stream, so that its frames are shown with the synthesised ones that belong to
// them and come later.
//
// Each shown frame sets a mark. The frame that had come `delay` marks ago belongs to the one shown
// now, whatever the rates of the two streams. Until there are so many marks, both streams are
// assumed to have one rate. Nothing allocates after construction.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

namespace gait {

class DelayedFrames {
 public:
  static constexpr int longest_delay = 63;  // marks

  // `values`: per frame; it starts with `first`.
  explicit DelayedFrames(const Eigen::VectorXf& first);

  // Stores a frame; a span of another size is ignored.
  void store(std::span<const float> values) noexcept;
  void mark() noexcept;
  // The frame that belongs to the last mark when that one is late by `delay` marks.
  std::span<const float> at(int delay) const noexcept;
  bool any() const noexcept { return stored_ > 0; }  // whether one was stored
  void reset() noexcept;                             // to `first`

 private:
  static constexpr int capacity = 4 * (longest_delay + 1);  // senders up to four times as fast

  std::span<const float> frame(int number) const noexcept;

  Eigen::MatrixXf frames_;  // ring of columns; number n is column n % capacity
  Eigen::VectorXf first_;
  int stored_ = 0;  // frames so far, the number of the newest; 0 is `first`
  std::array<int, longest_delay + 1> marks_{};  // ring: what was the newest then
  int marked_ = 0;
};

}  // namespace gait
