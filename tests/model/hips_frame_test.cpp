// The shift of an observation by another frame of the hips, against a body that is turned so.
#include "gait/model/hips_frame.h"

#include <gtest/gtest.h>

#include "gait/model/body_pose.h"

namespace gait {
namespace {

// Hips, a spine on them, a bone that never moves and the thigh below it; inputs: spine; outputs:
// hips, thigh. The thigh's second value is not modelled.
Model body_model() {
  Model model;
  Body body;
  body.skeleton.joints = {{"Hips", -1, {0, 0.9, 0}, {}},
                          {"Spine", 0, {0, 0.1, 0}, {{0, 0.5, 0}}},
                          {"Hip", 0, {0.1, 0, 0}, {}},
                          {"Thigh", 2, {0, -0.1, 0}, {{0, -0.4, 0}}}};
  body.roles = {Role::hips, Role::spine, Role::none, Role::left_thigh};
  for (int i = 0; i < 4; ++i)
    body.references.push_back(exponential_map<double>({0.4 * i, 0.7 - 0.3 * i, 0.2}).normalized());
  body.input_joints = {1};
  body.output_joints = {0, 3};
  body.hips_frame = 0.1;
  model.inputs = {{"Spine"}};
  model.outputs = {{"Hips"}, {"Thigh"}};
  model.input = {3, {0, 1, 2}, {1}};
  model.output = {6, {0, 1, 2, 3, 5}};
  model.input_scaling = {Eigen::VectorXd::Zero(6), Eigen::VectorXd::LinSpaced(6, 0.5, 2)};
  model.output_scaling = {Eigen::VectorXd::Zero(15), Eigen::VectorXd::LinSpaced(15, 0.3, 3)};
  model.body = body;
  return model;
}

Eigen::Vector3d values(const Eigen::Quaterniond& rotation, const Eigen::Quaterniond& reference) {
  Eigen::Vector3d result;
  values_from<double>(rotation, reference, result.data());
  return result;
}

TEST(HipsFrame, moves_statics_as_a_body_with_turned_hips_does) {
  const Model model = body_model();
  const Body& body = *model.body;
  const Eigen::MatrixXd shift = hips_frame_shift(model);
  ASSERT_EQ(shift.rows(), 6 + 15);
  ASSERT_EQ(shift.cols(), 3);
  for (int axis = 0; axis < 3; ++axis) {
    const double small = 1e-5;
    const Eigen::Quaterniond turn = exponential_map<double>(small * Eigen::Vector3d::Unit(axis));
    const auto& r = body.references;
    // Whatever the frame of the hips is, bones point where they did.
    const Eigen::Vector3d spine = values(turn.conjugate() * r[1], r[1]) / small;
    const Eigen::Vector3d hips = values(r[0] * turn, r[0]) / small;
    // The bone between stays as it is in the clip's frame: the thigh takes the turn.
    const Eigen::Vector3d thigh =
        values(r[2].conjugate() * turn.conjugate() * r[2] * r[3], r[3]) / small;
    const Eigen::VectorXd &in = model.input_scaling.deviation,
                          &out = model.output_scaling.deviation;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(shift(i, axis), 0.1 * spine[i] / in[i], 1e-5);
      EXPECT_NEAR(shift(6 + i, axis), 0.1 * hips[i] / out[i], 1e-5);
    }
    EXPECT_NEAR(shift(6 + 3, axis), 0.1 * thigh[0] / out[3], 1e-5);
    EXPECT_NEAR(shift(6 + 4, axis), 0.1 * thigh[2] / out[4], 1e-5);
  }
  EXPECT_TRUE(shift.middleRows(3, 3).isZero()) << "differences do not move";
  EXPECT_TRUE(shift.bottomRows(10).isZero());
}

TEST(HipsFrame, is_nothing_without_a_body_or_where_none_is_expected) {
  Model model = body_model();
  model.body->hips_frame = 0;
  EXPECT_EQ(hips_frame_shift(model).cols(), 0);
  model.body.reset();
  EXPECT_EQ(hips_frame_shift(model).cols(), 0);
}

}  // namespace
}  // namespace gait
