#include "gait/offline/reconstructed_clip.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "gait/error.h"
#include "gait/motion/rotation.h"

namespace gait {

namespace {

// Frames as they left the reconstructor, at the model's rate.
struct Made {
  std::vector<double> times;
  std::vector<std::vector<Eigen::Quaterniond>> poses;  // hips with heading out
  std::vector<double> headings;
  std::vector<Eigen::Vector3d> hips;
  std::vector<Decision> decisions;
  std::vector<std::vector<float>> styles;

  void add(const ReconstructedFrame& frame) {
    times.push_back(frame.time);
    poses.emplace_back();
    for (const auto& rotation : frame.pose) poses.back().push_back(rotation.cast<double>());
    headings.push_back(frame.heading);
    hips.push_back(frame.hips.cast<double>());
    decisions.push_back(frame.decision);
    styles.emplace_back(frame.styles.begin(), frame.styles.end());
  }
};

Made stream(const std::shared_ptr<const Model>& model, const BodyPoses& poses, double frame_rate,
            const PlaySettings& settings, ReconstructedClip& result) {
  const Body& body = *model->body;
  StreamReconstructor reconstructor(model, settings);
  result.delay_frames = reconstructor.delay();
  Made made;
  std::vector<Eigen::Quaternionf> inputs(body.input_joints.size());
  for (int frame = 0; frame < poses.frames(); ++frame) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const int joint = body.input_joints[i];
      Eigen::Quaterniond rotation = poses.pose(frame)[joint];
      // The reconstructor takes measured hips as they are in the world.
      if (body.roles[joint] == Role::hips)
        rotation = about_vertical(poses.heading[frame]) * rotation;
      inputs[i] = rotation.cast<float>();
    }
    const auto start = std::chrono::steady_clock::now();
    reconstructor.push(frame / frame_rate, inputs);
    bool more = reconstructor.next();
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    result.frame_microseconds.push_back(took.count());
    for (; more; more = reconstructor.next()) made.add(reconstructor.frame());
  }
  while (reconstructor.flush()) made.add(reconstructor.frame());
  return made;
}

}  // namespace

ReconstructedClip reconstruct_clip(std::shared_ptr<const Model> model, const BodyPoses& poses,
                                   double frame_rate, const std::string& name,
                                   const PlaySettings& settings) {
  if (!model->body)
    throw Error("model " + model->name + ": expected a model of a body; its streams are plain");
  ReconstructedClip result;
  const Body& body = *model->body;
  const JointRoles roles = body_roles(body);
  const Made made = stream(model, poses, frame_rate, settings, result);
  const int frames = poses.frames();
  result.clip = body_clip(body, name, frame_rate, frames);
  result.style_posteriors.resize(static_cast<Eigen::Index>(model->styles.size()), frames);
  if (made.times.empty()) return result;

  std::vector<Eigen::Quaterniond> pose(body.skeleton.joints.size());
  std::size_t at = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const double time = frame / frame_rate;
    const double tolerance = 1e-3 / frame_rate;
    while (at + 1 < made.times.size() && made.times[at + 1] <= time + tolerance) ++at;
    const std::size_t next = std::min(at + 1, made.times.size() - 1);
    const double gap = made.times[next] - made.times[at];
    const double share = gap > 0 ? std::clamp((time - made.times[at]) / gap, 0.0, 1.0) : 0.0;
    // On a tick of the model's clock the frame is that tick's, to the bit.
    const bool between = share * gap > tolerance;
    for (std::size_t joint = 0; joint < pose.size(); ++joint)
      pose[joint] = between ? slerp(made.poses[at][joint], made.poses[next][joint], share)
                            : made.poses[at][joint];
    const Eigen::Vector3d hips =
        between ? Eigen::Vector3d((1 - share) * made.hips[at] + share * made.hips[next])
                : made.hips[at];
    const double turn = std::remainder(made.headings[next] - made.headings[at],
                                       2 * std::numbers::pi);  // the shorter way round
    const double heading = made.headings[at] + (between ? share * turn : 0.0);
    place_body(result.clip, frame, roles, pose, heading, hips);
    result.decisions.push_back(made.decisions[at]);
    for (std::size_t style = 0; style < made.styles[at].size(); ++style)
      result.style_posteriors(static_cast<Eigen::Index>(style), frame) = made.styles[at][style];
  }
  return result;
}

}  // namespace gait
