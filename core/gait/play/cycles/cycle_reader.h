// The pose at a phase of a cycle that is a weighted sum of cycles, from the two frames around the
// phase. Nothing allocates after construction.
#pragma once

#include <span>

#include "gait/play/cycles/speed_tables.h"

namespace gait {

class CycleReader {
 public:
  explicit CycleReader(const SpeedTables& tables);  // which must outlive it

  void clear() noexcept { before_.setZero(), after_.setZero(); }
  // Any finite number of cycles; its whole part is dropped.
  void set_phase(double phase) noexcept;
  void add(const CyclesAround& cycles, float weight) noexcept;
  // Writes the body's local rotations, the hips' with heading out.
  void read(std::span<Eigen::Quaternionf> pose) const noexcept;

 private:
  const SpeedTables& tables_;
  int first_ = 0, second_ = 1;  // frames around the phase
  float share_ = 0;
  Eigen::VectorXf before_, after_;  // their pose vectors
};

}  // namespace gait
