#include "gait/play/cycles/cycle_reader.h"

#include <algorithm>
#include <cmath>

#include "gait/motion/rotation.h"

namespace gait {

CycleReader::CycleReader(const SpeedTables& tables) : tables_(tables) {
  before_ = after_ = Eigen::VectorXf::Zero(3 * static_cast<Eigen::Index>(tables.joints.size()));
}

void CycleReader::set_phase(double phase) noexcept {
  const double at = (phase - std::floor(phase)) * tables_.frames;
  first_ = std::min(static_cast<int>(at), tables_.frames - 1);
  second_ = (first_ + 1) % tables_.frames;
  share_ = static_cast<float>(at - first_);
}

void CycleReader::add(const CyclesAround& cycles, float weight) noexcept {
  const float a = weight * cycles.a, b = weight * cycles.b;
  before_ += a * cycles.first->col(first_) + b * cycles.second->col(first_);
  after_ += a * cycles.first->col(second_) + b * cycles.second->col(second_);
}

void CycleReader::read(std::span<Eigen::Quaternionf> pose) const noexcept {
  std::copy(tables_.references.begin(), tables_.references.end(), pose.begin());
  for (std::size_t i = 0; i < tables_.joints.size(); ++i) {
    // Neighbouring frames are so close that the straight line between their vectors is the arc.
    const auto place = static_cast<Eigen::Index>(3 * i);
    const Eigen::Vector3f vector =
        before_.segment<3>(place) + share_ * (after_.segment<3>(place) - before_.segment<3>(place));
    const auto joint = static_cast<std::size_t>(tables_.joints[i]);
    pose[joint] = tables_.references[joint] * exponential_map<float>(vector);
  }
}

}  // namespace gait
