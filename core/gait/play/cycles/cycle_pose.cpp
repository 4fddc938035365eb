#include "gait/play/cycles/cycle_pose.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gait/error.h"
#include "gait/model/body_pose.h"
#include "gait/motion/rotation.h"
#include "gait/motion/smoothing.h"

namespace gait {

namespace {

Eigen::Quaternionf rotation_of(const Eigen::VectorXf& values, std::size_t place,
                               const Eigen::Quaternionf& reference) noexcept {
  const auto first = static_cast<Eigen::Index>(3 * place);
  return reference * exponential_map<float>({values[first], values[first + 1], values[first + 2]});
}

// Rows of frames, one after the other, changed so that the last leads on into the first. A captured
// cycle ends where the next one began, which is not where it began itself; played in a circle the
// difference would be a kick between two frames. It is spread over the last fifth.
Eigen::MatrixXd closed(const Eigen::MatrixXd& frames_by_columns, int frames) {
  Eigen::MatrixXd result = frames_by_columns;
  const Eigen::Index values = result.rows() / frames;
  const int spread = frames / 5;
  if (spread < 2) return result;
  const auto frame = [&](int k) { return frames_by_columns.middleRows(k * values, values); };
  const Eigen::MatrixXd gap = frame(0) - (2 * frame(frames - 1) - frame(frames - 2));
  for (int k = frames - spread; k < frames; ++k) {
    const double share = static_cast<double>(k - (frames - spread)) / spread;
    result.middleRows(k * values, values) += smoothstep(share) * gap;
  }
  return result;
}

}  // namespace

std::shared_ptr<const CycleTables> make_cycle_tables(const CycleSpace& space, const Body& body) {
  const int joints = body.skeleton.size();
  if (space.frames < 2 || space.mean.size() != space.values() ||
      space.components.rows() != space.values())
    throw Error("cycle space: expected " + std::to_string(space.values()) +
                " values per cycle, found " + std::to_string(space.mean.size()) + " and " +
                std::to_string(space.components.rows()));
  for (const int joint : space.joints)
    if (joint < 0 || joint >= joints)
      throw Error("cycle space: expected joints of the body, 0 to " + std::to_string(joints - 1) +
                  ", found " + std::to_string(joint));
  auto tables = std::make_shared<CycleTables>();
  const Eigen::Index values = space.values() / space.frames;
  const Eigen::VectorXd mean = closed(space.mean, space.frames);
  const Eigen::MatrixXd components = closed(space.components, space.frames);
  for (int k = 0; k < space.frames; ++k) {
    tables->means.push_back(mean.segment(k * values, values).cast<float>());
    tables->components.push_back(components.middleRows(k * values, values).cast<float>());
  }
  tables->joints = space.joints;
  tables->references = float_references(body);
  return tables;
}

std::shared_ptr<const CycleTables> make_cycle_tables(const Model& model) {
  if (!model.style_space || !model.body)
    throw Error("model " + model.name + ": expected a space of styles for the style walker; it " +
                (model.styles.empty() ? "has no styles" : "was learnt without one") +
                "; train it from walks whose styles are named");
  return make_cycle_tables(model.style_space->space, *model.body);
}

CyclePose::CyclePose(std::shared_ptr<const CycleTables> tables) : tables_(std::move(tables)) {
  before_ = after_ = Eigen::VectorXf::Zero(tables_->means.front().size());
}

void CyclePose::read(double phase, const Eigen::VectorXf& scores,
                     std::span<Eigen::Quaternionf> pose) noexcept {
  const int frames = tables_->frames();
  const double at = (phase - std::floor(phase)) * frames;
  const int first = std::min(static_cast<int>(at), frames - 1), second = (first + 1) % frames;
  const auto share = static_cast<float>(at - first);
  // Eq. 3 of T10 for two frames instead of all.
  before_ = tables_->means[first];
  before_.noalias() += tables_->components[first] * scores;
  after_ = tables_->means[second];
  after_.noalias() += tables_->components[second] * scores;

  std::copy(tables_->references.begin(), tables_->references.end(), pose.begin());
  for (std::size_t i = 0; i < tables_->joints.size(); ++i) {
    const auto joint = static_cast<std::size_t>(tables_->joints[i]);
    const Eigen::Quaternionf& reference = tables_->references[joint];
    pose[joint] =
        slerp(rotation_of(before_, i, reference), rotation_of(after_, i, reference), share);
  }
}

}  // namespace gait
