#include "gait/play/body/motion_meter.h"

#include <algorithm>
#include <cmath>

#include "gait/motion/rotation.h"
#include "gait/motion/smoothing.h"

namespace gait {

namespace {

constexpr double seconds = 0.1;

// Largest over states and styles of the summed squares of first differences, per frame.
double largest_square(const Model& model) {
  double largest = 0;
  for (const Label& label : model.labels)
    for (const State& state : label.states) {
      if (state.trajectory_means.size() == 0) continue;
      const Eigen::Index values = model.trajectory_values();
      const double within = state.trajectory_variances.segment(values, values).sum();
      const Eigen::VectorXd means =
          state.trajectory_means.middleRows(values, values).colwise().squaredNorm().transpose();
      largest = std::max(largest, means.maxCoeff() + within);
    }
  if (largest > 0) return largest;
  // Models of before there were trajectory statistics: twice the outputs' mean.
  const Eigen::Index statics = model.output.statics();
  return 4 * (model.output_scaling.mean.segment(statics, statics).squaredNorm() +
              model.output_scaling.deviation.segment(statics, statics).squaredNorm());
}

}  // namespace

MotionMeter::MotionMeter(const Model& model)
    : rate_(static_cast<float>(model.frame_rate)),
      share_(first_order_gain(1 / model.frame_rate, seconds)),
      joints_(model.body->input_joints),
      before_(static_cast<std::size_t>(model.body->skeleton.size()),
              Eigen::Quaternionf::Identity()),
      speeds_(before_.size(), 0.0f) {
  joints_.insert(joints_.end(), model.body->output_joints.begin(), model.body->output_joints.end());
  const auto count = static_cast<double>(std::max<std::size_t>(1, joints_.size()));
  liveliest_ = static_cast<float>(model.frame_rate *
                                  std::sqrt(std::max(1e-12, largest_square(model)) / count));
}

void MotionMeter::reset() noexcept {
  started_ = false;
  squares_ = energy_ = 0;
  std::ranges::fill(speeds_, 0.0f);
}

void MotionMeter::advance(std::span<const Eigen::Quaternionf> pose) noexcept {
  if (pose.size() != before_.size()) return;
  if (started_)
    for (std::size_t i = 0; i < pose.size(); ++i)
      speeds_[i] = rate_ * angle_between<float>(before_[i], pose[i]);
  started_ = true;
  std::ranges::copy(pose, before_.begin());
  float sum = 0;
  for (const int joint : joints_) sum += speed(joint) * speed(joint);
  squares_ +=
      share_ * (sum / static_cast<float>(std::max<std::size_t>(1, joints_.size())) - squares_);
  energy_ = std::min(1.0f, std::sqrt(squares_) / liveliest_);
}

}  // namespace gait
