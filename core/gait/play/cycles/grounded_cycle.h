// A captured cycle with any share of its stride.
//
// Joint angles half-way between a step and standing (G04 §4.1) do not make half a step: the
// swinging foot no longer clears the ground, the standing one leaves it, and both slide (G04 §6).
// Here the upper body is half-way, each foot travels half as far, its sole keeps its distance to
// the ground, and hip and knee follow (two-bone inverse kinematics). The whole stride is the cycle
// as it is, save that a knee never bends the wrong way.
//
// Metres, radians; +Z ahead, Y up; poses with heading out; phase 0 at the right contact, 0.5 at the
// left.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "gait/model/model.h"
#include "gait/motion/kinematics.h"

namespace gait {

class GroundedCycle {
 public:
  // `joints`: of the body, ascending, three values each in what follows. Throws Error when the body
  // lacks hips, a thigh, a shank or a foot.
  GroundedCycle(const Body& body, const std::vector<int>& joints);

  // A cycle with `share` (0 to 1) of the stride of `walking`. Both as pose vectors, one column per
  // frame; `standing` is one column.
  Eigen::MatrixXd with_stride(const Eigen::MatrixXd& walking, const Eigen::VectorXd& standing,
                              double share) const;

 private:
  struct SolePoint {
    int joint = 0;
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  };
  struct Placed {  // a pose in the world, hips at the origin
    std::vector<Eigen::Quaterniond> local;
    std::vector<Placement<double>> world;
  };

  struct Ground {                      // per frame, against the hips
    std::vector<double> height;        // of the ground
    std::vector<double> clearance[2];  // of each sole over it
  };

  // `flattened`: 0 to 1, how much of their distance to the ground feet in stance lose.
  Ground ground_under(const std::vector<Placed>& steps, double flattened) const;
  Placed placed(const Eigen::VectorXd& values) const;
  void place(Placed& pose) const;
  double too_far(const Placed& pose, const Placed& step, const Leg& leg,
                 const Eigen::Vector3d& ankle) const;
  double lowest(const Placed& pose, const std::vector<SolePoint>& sole) const;
  void reach(Placed& pose, const Leg& leg, const Eigen::Vector3d& ankle,
             const Eigen::Quaterniond& foot) const;

  const Body& body_;
  std::vector<int> joints_;
  JointRoles roles_;
  std::vector<SolePoint> soles_[2];  // right, left
};

}  // namespace gait
