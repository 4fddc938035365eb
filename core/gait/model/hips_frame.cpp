#include "gait/model/hips_frame.h"

#include <algorithm>

#include "gait/model/stream_layout.h"

namespace gait {

namespace {

// Fills the rows of the static values of joints, wherever they stand in z.
class ShiftRows {
 public:
  explicit ShiftRows(const Model& model)
      : model_(model),
        inputs_(StreamLayout::of_inputs(model)),
        outputs_(StreamLayout::of_outputs(model)),
        rows_(Eigen::MatrixXd::Zero(model.input.size() + model.output.size(), 3)) {}

  // `moves`: by how much the joint's rotation vector does, per radian of the frame's turn. False
  // when no value of the joint is modelled.
  bool set(int joint, const Eigen::Matrix3d& moves) {
    const bool in = set(inputs_, joint, moves, model_.input.modelled, model_.input_scaling, 0);
    const bool out = set(outputs_, joint, moves, model_.output.modelled, model_.output_scaling,
                         model_.input.size());
    return in || out;
  }

  Eigen::MatrixXd take() { return std::move(rows_); }

 private:
  bool set(const StreamLayout& streams, int joint, const Eigen::Matrix3d& moves,
           const std::vector<int>& modelled, const Scaling& scaling, int first) {
    const int stream = streams.stream_of(joint);
    if (stream < 0) return false;
    bool any = false;
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = std::ranges::lower_bound(modelled, streams[stream].begin + axis);
      if (at == modelled.end() || *at != streams[stream].begin + axis) continue;
      const auto entry = at - modelled.begin();
      rows_.row(first + entry) = moves.row(axis) / scaling.deviation[entry];
      any = true;
    }
    return any;
  }

  const Model& model_;
  StreamLayout inputs_, outputs_;
  Eigen::MatrixXd rows_;
};

}  // namespace

Eigen::MatrixXd hips_frame_shift(const Model& model) {
  const Eigen::Index entries = model.input.size() + model.output.size();
  if (!model.body || !(model.body->hips_frame > 0)) return Eigen::MatrixXd::Zero(entries, 0);
  const Body& body = *model.body;
  const auto hips = std::ranges::find(body.roles, Role::hips) - body.roles.begin();
  if (hips == body.skeleton.size()) return Eigen::MatrixXd::Zero(entries, 0);

  ShiftRows rows(model);
  rows.set(static_cast<int>(hips), body.hips_frame * Eigen::Matrix3d::Identity());
  // A joint that never moves hands the turn on to those below it.
  std::vector<bool> hands_on(body.references.size(), false);
  std::vector<Eigen::Quaterniond> turned = body.references;  // from the hips
  hands_on[hips] = true;
  turned[hips] = Eigen::Quaterniond::Identity();
  for (int joint = 0; joint < body.skeleton.size(); ++joint) {
    const int parent = body.skeleton.joints[joint].parent;
    if (joint == hips || parent < 0 || !hands_on[parent]) continue;
    turned[joint] = turned[parent] * body.references[joint];
    hands_on[joint] =
        !rows.set(joint, -body.hips_frame * turned[joint].conjugate().toRotationMatrix());
  }
  return rows.take();
}

}  // namespace gait
