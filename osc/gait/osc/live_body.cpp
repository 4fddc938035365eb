#include "gait/osc/live_body.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "gait/model/body_pose.h"

namespace gait::osc {

namespace {

constexpr double never = -1e9;            // seconds
constexpr int most_heading_frames = 512;  // a cycle of 2 s at 240 frames per second

int joints_of(const Model& model) { return model.body ? model.body->skeleton.size() : 0; }

int input_named(const Model& model, const std::string& name) {
  for (std::size_t i = 0; i < model.inputs.size(); ++i)
    if (model.inputs[i].name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace

HumanoidBody humanoid_of(const Body& body) {
  return HumanoidBody(body.skeleton, body_roles(body), body.references);
}

LiveBody::LiveBody(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      filter_(joints_of(*model_)),
      heading_(CausalHeading<double>::over_seconds(model_->body ? model_->body->heading_window : 1,
                                                   most_heading_frames)),
      input_of_(model_->inputs.size(), -1),
      inputs_(static_cast<std::size_t>(values_of(model_->inputs)), 0) {
  if (!model_->body) return;
  const Body& body = *model_->body;
  const JointRoles roles = body_roles(body);
  if (roles.has_legs()) {
    humanoid_.emplace(humanoid_of(body));
    hips_ = roles.hips;
    right_to_left_thigh_ = body.skeleton.place_at_rest(roles.left.thigh, roles.hips) -
                           body.skeleton.place_at_rest(roles.right.thigh, roles.hips);
    for (int joint = roles.left.foot; joint != roles.hips;
         joint = body.skeleton.joints[joint].parent)
      rest_height_ += body.skeleton.joints[joint].offset.norm();
  }
  references_ = float_references(body);
  for (std::size_t i = 0; i < body.input_joints.size(); ++i) {
    const int input = input_named(*model_, body.skeleton.joints[body.input_joints[i]].name);
    if (input >= 0) input_of_[input] = body.input_joints[i];
  }
  local_.assign(body.references.begin(), body.references.end());
  pose_ = references_;
  seen_.assign(local_.size(), never);
  named_of_.assign(local_.size(), -1);
  values_.resize(3 * local_.size());
}

void LiveBody::reset() noexcept {
  calibration_.reset();
  calibrate_.reset();
  standing_.reset();
  forget_pose();
}

void LiveBody::take_over(const LiveBody& other) noexcept {
  sender_ = other.sender_;
  calibrate_ = other.calibrate_;
  calibrate_until_ = other.calibrate_until_;
  standing_ = other.standing_;
  if (standing_ && humanoid_)
    calibration_.set(standing_->sender, humanoid_->calibration(standing_->pose));
}

void LiveBody::forget_pose() noexcept {
  sender_.reset();
  filter_.reset();
  heading_.reset();
  std::fill(seen_.begin(), seen_.end(), never);
  std::fill(named_of_.begin(), named_of_.end(), -1);
  named_known_ = 0;
}

bool LiveBody::take(const CapturedFrame& captured) noexcept {
  frame_.time = captured.time;
  frame_.posed = true;
  if (captured.form != MocapForm::gait) return take_humanoid(captured);
  if (captured.values > 0) return take_values(captured);
  return take_named(captured);
}

bool LiveBody::take_humanoid(const CapturedFrame& captured) noexcept {
  if (!humanoid_) return false;
  if (captured.time > calibrate_until_) calibrate_.reset();
  if (calibrate_) sender_.judge_axes_again();
  if (!sender_.take(captured)) return false;
  if (calibrate_) {
    // Waits until the hips are known: a frame may arrive in pieces.
    if (calibration_.set(sender_.world(), humanoid_->calibration(*calibrate_))) {
      standing_ = Standing{sender_.world(), *calibrate_};
      calibrate_.reset();
      filter_.reset();
      heading_.reset();
    }
  }
  body_pose_ = sender_.world();
  calibration_.apply(body_pose_, yaw_);
  humanoid_->drive(body_pose_, local_);
  const auto& joints = humanoid_->joints();
  for (std::size_t joint = 0; joint < local_.size(); ++joint) {
    const int bone = joints[joint].bone;
    double seen = never;
    if (bone >= 0 && humanoid_->driven(body_pose_, static_cast<int>(joint))) {
      seen = sender_.seen(bone);
      // A spine follows all of its bones.
      if (bone == index_of(Bone::spine))
        for (int other = bone; other <= index_of(Bone::upper_chest); ++other)
          if (body_pose_.turned[other]) seen = std::max(seen, sender_.seen(other));
    }
    seen_[joint] = seen;
  }
  const auto hips = static_cast<std::size_t>(index_of(Bone::hips));
  frame_.hips = body_pose_.placed[hips] ? Eigen::Vector3f(body_pose_.places[hips].cast<float>())
                                        : Eigen::Vector3f(0, static_cast<float>(rest_height_), 0);
  finish(captured);
  return true;
}

void LiveBody::find_joints(const CapturedFrame& captured) noexcept {
  if (captured.joints == named_known_ && !captured.rig_changed) return;
  named_known_ = captured.joints;
  const Skeleton& skeleton = model_->body->skeleton;
  for (std::size_t joint = 0; joint < named_of_.size(); ++joint) {
    named_of_[joint] = -1;
    for (int i = 0; i < captured.joints; ++i)
      if (skeleton.joints[joint].name == captured.named[i].name.data()) named_of_[joint] = i;
  }
}

bool LiveBody::take_named(const CapturedFrame& captured) noexcept {
  if (!model_->body) return false;
  find_joints(captured);
  const Skeleton& skeleton = model_->body->skeleton;
  const auto rotation = [&](const NamedJoint& joint) {
    return Eigen::Quaterniond(joint.rotation[3], joint.rotation[0], joint.rotation[1],
                              joint.rotation[2]);
  };
  bool any = false;
  for (std::size_t joint = 0; joint < named_of_.size(); ++joint) {
    if (named_of_[joint] < 0) continue;
    const NamedJoint& named = captured.named[named_of_[joint]];
    if (!named.rotated) continue;
    any = true;
    seen_[joint] = captured.time;
    if (named.relative) {
      local_[joint] = model_->body->references[joint] *
                      exponential_map<double>({named.vector[0], named.vector[1], named.vector[2]});
      continue;
    }
    // Includes joints of the sender's rig that the model lacks, up to the parent in the model.
    const int parent = skeleton.joints[joint].parent;
    const int end = static_cast<int>(joint) == hips_ || parent < 0 ? -1 : named_of_[parent];
    Eigen::Quaterniond turned = rotation(named);
    int steps = 0;
    for (int above = named.above; above >= 0 && above != end && steps < most_joints;
         above = captured.named[above].above, ++steps)
      turned = rotation(captured.named[above]) * turned;
    local_[joint] = turned.normalized();
  }
  if (!any) return false;
  if (hips_ >= 0 && named_of_[hips_] >= 0) {
    const NamedJoint& named = captured.named[named_of_[hips_]];
    Eigen::Vector3d place(named.place[0], named.place[1], named.place[2]);
    int steps = 0;
    for (int above = named.above; above >= 0 && steps < most_joints;
         above = captured.named[above].above, ++steps) {
      const NamedJoint& at = captured.named[above];
      place = rotation(at) * place + Eigen::Vector3d(at.place[0], at.place[1], at.place[2]);
    }
    const Eigen::Quaterniond turn = about_vertical(yaw_);
    if (!named.relative) local_[hips_] = turn * local_[hips_];
    frame_.hips = (turn * place).cast<float>();
  }
  finish(captured);
  return true;
}

bool LiveBody::take_values(const CapturedFrame& captured) noexcept {
  const auto count = static_cast<std::size_t>(captured.values);
  const std::span<const float> numbers(captured.numbers.data(), count);
  if (captured.root_told) {
    const Eigen::Vector3d place(captured.root[0], captured.root[1], captured.root[2]);
    frame_.hips = (about_vertical(yaw_) * place).cast<float>();
  }
  frame_.heading = captured.heading + static_cast<float>(yaw_);
  if (count == inputs_.size() && (!model_->body || count != values_.size())) {
    std::copy(numbers.begin(), numbers.end(), inputs_.begin());
    frame_.posed = false;
    for (std::size_t i = 0; i < input_of_.size(); ++i)
      if (input_of_[i] >= 0) seen_[input_of_[i]] = captured.time;
    frame_.inputs = inputs_;
    frame_.pose = {};
    return true;
  }
  if (!model_->body || count != values_.size()) return false;
  for (std::size_t joint = 0; joint < local_.size(); ++joint) {
    local_[joint] = rotation_from<float>(numbers.subspan(3 * joint).first<3>(), references_[joint])
                        .cast<double>();
    seen_[joint] = captured.time;
  }
  filter(captured.time);
  for (std::size_t joint = 0; joint < local_.size(); ++joint)
    pose_[joint] = local_[joint].cast<float>();
  pose_vector<float>(pose_, references_, values_);
  pose_vector<float>(pose_, references_, model_->body->input_joints, inputs_);
  frame_.inputs = inputs_;
  frame_.pose = values_;
  return true;
}

void LiveBody::filter(double time) noexcept {
  filter_.apply(local_, time - filtered_at_);
  filtered_at_ = time;
}

void LiveBody::finish(const CapturedFrame& captured) noexcept {
  filter(captured.time);
  double heading = 0;
  if (hips_ >= 0) heading = heading_.advance(local_[hips_] * right_to_left_thigh_, captured.time);
  for (std::size_t joint = 0; joint < local_.size(); ++joint)
    pose_[joint] = static_cast<int>(joint) == hips_
                       ? (about_vertical(-heading) * local_[joint]).cast<float>()
                       : local_[joint].cast<float>();
  pose_vector<float>(pose_, references_, values_);
  pose_vector<float>(pose_, references_, model_->body->input_joints, inputs_);
  frame_.heading = static_cast<float>(heading);
  frame_.inputs = inputs_;
  frame_.pose = values_;
}

bool LiveBody::there(int input) const noexcept {
  const int joint = input_of_[input];
  return joint < 0 || frame_.time - seen_[joint] <= hold_;
}

}  // namespace gait::osc
