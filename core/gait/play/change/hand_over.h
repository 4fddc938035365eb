// Inertialisation: a hand-over from one motion to another without a jump. It adds to the new motion
// what the old one differed by in place and speed, and fades that to zero.
//
// A quintic: x(0) and x'(0) as they are, x''(0) = x(1) = x'(1) = x''(1) = 0. It needs no second
// motion to fade from, and a hand-over in the middle of another is as smooth.
#pragma once

#include <Eigen/Core>

namespace gait {

inline constexpr double hand_over_seconds = 0.5;  // about one step

class HandOver {
 public:
  // `seconds`: how long it takes.
  HandOver(int values, double frame_rate, double seconds);

  // `offset`: shown minus new motion at the last frame shown, `before`: at the frame before it.
  void begin(const Eigen::Ref<const Eigen::VectorXf>& offset,
             const Eigen::Ref<const Eigen::VectorXf>& before) noexcept;
  // Moves on by one frame: what is to be added to the new motion. Zero once it is over.
  const Eigen::VectorXf& advance() noexcept;
  bool over() const noexcept { return frame_ >= frames_; }
  void stop() noexcept { frame_ = frames_; }

 private:
  Eigen::VectorXf place_, speed_;  // at the beginning; per frame
  Eigen::VectorXf offset_;
  int frames_, frame_;
};

}  // namespace gait
