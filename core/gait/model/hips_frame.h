// The hips' frame: what it does to an observation when another body's lies otherwise.
//
// Rigs and marker sets define the frame of the pelvis differently. Then the rotations of all that
// hangs on the hips shift together: the root of the spine, which is measured, and both thighs,
// which are sought. The upper body cannot tell this from a stoop.
#pragma once

#include <Eigen/Core>

#include "gait/model/model.h"

namespace gait {

// How a scaled z = [x; y] moves per deviation of the hips' frame about each of its axes
// (body.hips_frame, radians): z's entries by 3, so that the shift adds G G^T to a covariance of z.
// For a small turn d of the frame, the rotation vector of a joint with reference R, counted from
// the hips, moves by -R^-1 d; that of the hips themselves by d. Differences do not move. No columns
// when the model has no body or expects no shift.
Eigen::MatrixXd hips_frame_shift(const Model& model);

}  // namespace gait
