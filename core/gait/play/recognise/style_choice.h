// Style choice: one style out of posteriors that change every frame. A style is chosen once it has
// led all others by a margin for a while, and stays until another has.
#pragma once

#include <span>

namespace gait {

class StyleChoice {
 public:
  // `frame_rate`: of the posteriors, per second.
  explicit StyleChoice(double frame_rate) : frame_rate_(frame_rate) {}

  // Takes a frame's posteriors (sum 1). True when the choice changed.
  bool advance(std::span<const float> posteriors) noexcept;
  int style() const noexcept { return style_; }  // -1: none yet

  void set_margin(float margin) noexcept { margin_ = margin; }  // 0 to 1
  void set_hold(double seconds) noexcept { hold_ = seconds; }   // 0 or more
  void reset() noexcept;

 private:
  double frame_rate_;
  float margin_ = 0.1f;
  double hold_ = 0.3;
  int style_ = -1, leading_ = -1;
  int led_ = 0;  // frames in a row
};

}  // namespace gait
