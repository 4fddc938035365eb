#include "gait/osc/body_sender.h"

#include "gait/error.h"
#include "gait/model/body_pose.h"
#include "gait/motion/kinematics.h"
#include "gait/osc/live_body.h"

namespace gait::osc {

namespace {

int values_in(const Model& model) {
  if (!model.body)
    throw Error("model " + model.name + " has no body to send: its streams are plain");
  return 3 * model.body->skeleton.size();
}

}  // namespace

BodySender::BodySender(std::shared_ptr<const Model> model, MocapForm form)
    : model_(std::move(model)), form_(form), own_(values_in(*model_)) {
  const Body& body = *model_->body;
  hips_ = body_roles(body).hips;
  local_ = world_ = body.references;
  for (const Joint& joint : body.skeleton.joints) translations_.push_back(joint.offset);
  places_ = translations_;
  if (form == MocapForm::gait) return;
  body_.emplace(humanoid_of(body));
  body_->read(world_, {}, pose_);
  std::vector<int> bones;
  for (int bone = 0; bone < humanoid_bones; ++bone)
    if (pose_.turned[bone]) bones.push_back(bone);
  humanoid_.emplace(form, bones);
}

bool BodySender::send(std::span<const float> root, std::span<const float> pose, double time,
                      std::span<const std::shared_ptr<const Destination>> to) noexcept {
  if (root.size() != 4 || pose.size() != 3 * local_.size()) return false;
  const Skeleton& skeleton = model_->body->skeleton;
  bool sent = true;
  const auto send_all = [&](const auto& packets) {
    for (const auto& destination : to)
      for (const auto& packet : packets)
        if (!destination->send(packet.bytes())) sent = false;
  };
  if (form_ == MocapForm::gait) {
    own_.pack(root, pose);
    send_all(own_.packets());
  } else {
    for (std::size_t joint = 0; joint < local_.size(); ++joint) {
      const Eigen::Vector3d vector(pose[3 * joint], pose[3 * joint + 1], pose[3 * joint + 2]);
      local_[joint] = model_->body->references[joint] * exponential_map<double>(vector);
    }
    // Joints above the hips keep their pose.
    for (int above = skeleton.joints[hips_].parent; above >= 0;
         above = skeleton.joints[above].parent) {
      local_[above].setIdentity();
      translations_[above].setZero();
    }
    local_[hips_] = about_vertical(static_cast<double>(root[3])) * local_[hips_];
    translations_[hips_] = Eigen::Vector3d(root[0], root[1], root[2]);
    forward_kinematics(skeleton, local_, translations_, world_, places_);
    body_->read(world_, places_, pose_);
    humanoid_->pack(pose_, time, count_++);
    send_all(humanoid_->packets());
  }
  return sent;
}

}  // namespace gait::osc
