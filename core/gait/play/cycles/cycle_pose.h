// Poses read out of a cycle space at any phase: what the style walker (T10 §7.2) and the speed
// walker (G04 §4) share.
//
// Only the two frames around the phase are taken from the scores, not the whole cycle: two products
// of 3 * joints by components, then SLERP between the two poses. Radians; phase in cycles.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "gait/model/cycle_space.h"
#include "gait/model/model.h"

namespace gait {

// A cycle space in single precision, frame by frame, its cycles closed: the last fifth is bent so
// that it leads on into the first frame. Walkers share it; it never changes.
struct CycleTables {
  std::vector<Eigen::VectorXf> means;          // per frame: 3 values per joint
  std::vector<Eigen::MatrixXf> components;     // per frame: values by components
  std::vector<int> joints;                     // of the body
  std::vector<Eigen::Quaternionf> references;  // one per joint of the body
  int frames() const { return static_cast<int>(means.size()); }
  int kept() const { return static_cast<int>(components.front().cols()); }
};

// Throws Error when the space does not fit the body.
std::shared_ptr<const CycleTables> make_cycle_tables(const CycleSpace& space, const Body& body);
// Of the model's space of styles. Throws Error when it has none, saying how to train one that has.
std::shared_ptr<const CycleTables> make_cycle_tables(const Model& model);

class CyclePose {
 public:
  explicit CyclePose(std::shared_ptr<const CycleTables> tables);

  // Writes the body's local rotations at `phase` (any finite number; its whole part is dropped) of
  // the cycle with these scores (one per component), the hips' with heading out. After the last
  // frame comes the first. Joints outside the space stay at their references. `pose`: one rotation
  // per joint of the body.
  void read(double phase, const Eigen::VectorXf& scores,
            std::span<Eigen::Quaternionf> pose) noexcept;

  int components() const noexcept { return tables_->kept(); }
  const CycleTables& tables() const noexcept { return *tables_; }

 private:
  std::shared_ptr<const CycleTables> tables_;
  Eigen::VectorXf before_, after_;  // pose vectors of the two frames
};

}  // namespace gait
