#include "gait/teach/walk_takes.h"

#include <cmath>

#include "gait/error.h"
#include "gait/model/body_pose.h"

namespace gait {

namespace {

constexpr double hips_height = 0.9;  // metres; any will do, as steps are found relative to the hips

std::vector<std::string> names_of(const Body& body, const std::vector<int>& joints) {
  std::vector<std::string> names;
  for (const int joint : joints) names.push_back(body.skeleton.joints[joint].name);
  return names;
}

double rate_of(const RecordedTake& take) {
  return take.duration() > 0 ? (take.frames() - 1) / take.duration() : 0;
}

std::vector<Walk> walks_of_takes(const std::vector<RecordedTake>& takes, const Body& body) {
  const auto joints = body.references.size();
  const JointRoles roles = body_roles(body);
  std::vector<Walk> walks;
  for (std::size_t number = 0; number < takes.size(); ++number) {
    const RecordedTake& recorded = takes[number];
    const std::string name = "take " + std::to_string(number) + " ('" + recorded.label + "')";
    if (recorded.inputs != static_cast<int>(3 * joints))
      throw Error(name + ": expected " + std::to_string(3 * joints) +
                  " values per pose, as the body has; found " + std::to_string(recorded.inputs));
    // Whole frames per second keep the clip's clock exact; captures run at 25 to 240.
    const double rate = std::clamp(std::round(rate_of(recorded)), 10.0, 240.0);
    const Take take = at_rate(recorded, rate);
    const int frames = static_cast<int>(take.inputs.cols());
    Walk walk;
    walk.style = recorded.label;
    walk.clip = body_clip(body, name, rate, frames);
    std::vector<Eigen::Quaterniond> pose(joints);
    for (int frame = 0; frame < frames; ++frame) {
      for (std::size_t joint = 0; joint < joints; ++joint) {
        const Eigen::Vector3d values =
            take.inputs.col(frame).segment<3>(static_cast<Eigen::Index>(3 * joint));
        pose[joint] = rotation_from<double>(std::span<const double, 3>(values.data(), 3),
                                            body.references[joint]);
      }
      place_body(walk.clip, frame, roles, pose, 0, {0, hips_height, 0});
    }
    walks.push_back(std::move(walk));
  }
  return walks;
}

}  // namespace

TakesLearnt learn_walk_takes(const std::vector<RecordedTake>& takes, const Body& body,
                             const std::string& name, const TakeOptions& options) {
  if (takes.empty()) throw Error("expected at least one take; found none");
  const std::vector<Walk> walks = walks_of_takes(takes, body);
  WalkOptions walk_options;
  walk_options.frame_rate = options.frame_rate;
  walk_options.input_joints = names_of(body, body.input_joints);
  walk_options.output_joints = names_of(body, body.output_joints);
  SelectionOptions selection;
  selection.learning.hmm.threads = options.threads;
  selection.learning.hmm.cancel = options.cancel;
  selection.learning.hmm.progress = options.progress;
  ModelOrigin origin;
  origin.name = name;
  TakesLearnt learnt;
  learnt.model = learn_walks(walks, {}, walk_options, selection, origin).selected.model;
  learnt.judged.takes = static_cast<int>(walks.size());
  learnt.judged.accuracy = learnt.model.training.validated_step_accuracy;
  learnt.judged.error = learnt.model.training.validated_error;
  return learnt;
}

}  // namespace gait
