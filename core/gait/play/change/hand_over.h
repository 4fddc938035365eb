// Inertialisation: a hand-over from one motion to another without a jump. What the old motion
// differs by at that moment, in place and in speed, fades away while the new one goes on.
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
