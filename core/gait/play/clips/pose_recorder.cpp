#include "gait/play/clips/pose_recorder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "gait/error.h"
#include "gait/play/body/root_motion.h"

namespace gait {

namespace {

constexpr double block_seconds = 30;

const Body& body_of(const Model& model) {
  if (!model.body)
    throw Error("model " + model.name + ": expected a model of a body; its streams are plain");
  return *model.body;
}

}  // namespace

PoseRecorder::PoseRecorder(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      all_joints_(body_of(*model_).skeleton.joints.size()),
      block_frames_(std::max(1, static_cast<int>(std::lround(block_seconds * model_->frame_rate)))),
      most_frames_(static_cast<int>(std::lround(longest_seconds * model_->frame_rate))) {
  std::iota(all_joints_.begin(), all_joints_.end(), 0);
  for (const auto& reference : model_->body->references)
    references_.push_back(reference.cast<float>());
  blocks_.reserve(static_cast<std::size_t>(most_frames_ / block_frames_ + 1));
  clear();
}

void PoseRecorder::clear() {
  blocks_.clear();
  frames_ = 0;
  inputs_wait_ = root_told_ = false;
  pose_ = references_;
  hips_.setZero();
  heading_ = 0;
}

bool PoseRecorder::take(std::span<const float> values, std::span<const int> joints) {
  if (values.size() != 3 * joints.size()) return false;
  if (!std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); }))
    return false;
  for (std::size_t i = 0; i < joints.size(); ++i)
    pose_[joints[i]] =
        rotation_from<float>(values.subspan(3 * i).first<3>(), references_[joints[i]]);
  return true;
}

bool PoseRecorder::take_pose(std::span<const float> values, double time) {
  if (full() || !take(values, all_joints_)) return false;
  inputs_wait_ = false;
  last_time_ = time;
  return keep();
}

bool PoseRecorder::take_outputs(std::span<const float> values, double time) {
  if (full() || !take(values, model_->body->output_joints)) return false;
  inputs_wait_ = false;
  last_time_ = time;
  return keep();
}

bool PoseRecorder::take_inputs(std::span<const float> values, double time) {
  if (full() || values.size() != 3 * model_->body->input_joints.size()) return false;
  if (inputs_wait_) {
    last_time_ = inputs_time_;
    keep();
  }
  inputs_wait_ = take(values, model_->body->input_joints);
  inputs_time_ = time;
  return inputs_wait_;
}

bool PoseRecorder::take_root(const Eigen::Vector3f& hips, float heading) {
  if (full() || !hips.allFinite() || !std::isfinite(heading)) return false;
  hips_ = hips;
  heading_ = heading;
  root_told_ = true;
  return true;
}

bool PoseRecorder::keep() {
  if (frames_ % block_frames_ == 0) {
    Block& block = blocks_.emplace_back();
    const auto frames = static_cast<std::size_t>(block_frames_);
    block.rotations.reserve(frames * pose_.size());
    block.hips.reserve(frames);
    block.heading.reserve(frames);
  }
  Block& block = blocks_.back();
  block.rotations.insert(block.rotations.end(), pose_.begin(), pose_.end());
  block.hips.push_back(hips_);
  block.heading.push_back(heading_);
  if (frames_++ == 0) first_time_ = last_time_;
  return true;
}

PoseRecorder::Recording PoseRecorder::finish() {
  if (inputs_wait_ && !full()) {
    last_time_ = inputs_time_;
    keep();
  }
  Recording recording;
  recording.model_ = model_;
  recording.blocks_ = std::exchange(blocks_, {});
  recording.block_frames_ = block_frames_;
  recording.frames_ = frames_;
  recording.seconds_ = last_time_ - first_time_;
  recording.root_told_ = root_told_;
  blocks_.reserve(static_cast<std::size_t>(most_frames_ / block_frames_ + 1));
  clear();
  return recording;
}

double PoseRecorder::Recording::frame_rate() const {
  const double rate = seconds_ > 0 ? (frames_ - 1) / seconds_ : 0;
  const double against_model = rate / model_->frame_rate;
  // Outside of this somebody stepped through frames by hand, or sent them all at once.
  const bool sensible = against_model > 0.2 && against_model < 8;
  return sensible && std::abs(against_model - 1) > 0.05 ? rate : model_->frame_rate;
}

BodyMotion PoseRecorder::Recording::motion(const std::string& name) const {
  const Body& body = *model_->body;
  BodyMotion motion;
  motion.name = name;
  motion.frame_rate = frame_rate();
  motion.joints = body.skeleton.size();
  for (const Block& block : blocks_) {
    motion.rotations.insert(motion.rotations.end(), block.rotations.begin(), block.rotations.end());
    motion.hips.insert(motion.hips.end(), block.hips.begin(), block.hips.end());
    motion.heading.insert(motion.heading.end(), block.heading.begin(), block.heading.end());
  }
  for (std::size_t frame = 1; frame < motion.heading.size(); ++frame)  // unwrapped
    motion.heading[frame] = motion.heading[frame - 1] +
                            std::remainder(motion.heading[frame] - motion.heading[frame - 1],
                                           2 * std::numbers::pi_v<float>);
  const JointRoles roles = body_roles(body);
  if (!root_told_ && roles.has_legs()) {
    RootMotion root(body.skeleton, roles, motion.frame_rate);
    for (int frame = 0; frame < motion.frames(); ++frame)
      motion.hips[frame] = root.advance(motion.pose(frame));
  }
  find_steps(motion, body);
  return motion;
}

}  // namespace gait
