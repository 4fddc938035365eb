#include "gait/offline/walk_recorder.h"

namespace gait {

namespace {

Body scaled(Body body, double scale) {
  for (Joint& joint : body.skeleton.joints) {
    joint.offset *= scale;
    for (Eigen::Vector3d& tip : joint.tips) tip *= scale;
  }
  return body;
}

}  // namespace

WalkRecorder::WalkRecorder(const Body& body, double frame_rate, double scale, double turn)
    : body_(scaled(body, scale)),
      roles_(body_roles(body_)),
      frame_rate_(frame_rate),
      turn_(turn),
      root_(body_.skeleton, roles_, frame_rate),
      lock_(body_.skeleton, roles_, frame_rate) {
  root_.set_gentle(1);
}

// Returns the hips' place.
Eigen::Vector3d WalkRecorder::stand(std::span<const Eigen::Quaternionf> pose, double heading) {
  standing_.assign(pose.begin(), pose.end());
  const auto turned = static_cast<float>(heading);
  const Eigen::Vector3f hips = root_.advance(standing_, turned);
  lock_.apply(standing_, root_, turned);
  return hips.cast<double>();
}

void WalkRecorder::add(std::span<const Eigen::Quaternionf> pose) {
  const double heading = turn_ * frames() / frame_rate_;
  const Eigen::Vector3d hips = stand(pose, heading);
  if (hips_.empty()) start_ = {hips.x(), 0, hips.z()};
  hips_.push_back(hips - start_);
  for (const Eigen::Quaternionf& rotation : standing_)
    rotations_.push_back(rotation.cast<double>());
}

Clip WalkRecorder::clip(const std::string& name) const {
  Clip clip = body_clip(body_, name, frame_rate_, frames());
  const std::size_t joints = body_.skeleton.joints.size();
  for (int frame = 0; frame < frames(); ++frame) {
    const std::size_t at = static_cast<std::size_t>(frame);
    place_body(clip, frame, roles_, {rotations_.data() + at * joints, joints},
               turn_ * frame / frame_rate_, hips_[at]);
  }
  return clip;
}

}  // namespace gait
