#include "gait/play/clips/pose_recorder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "gait/motion/finite.h"
#include "gait/play/body/root_motion.h"

namespace gait {

namespace {

constexpr double block_seconds = 30;

}  // namespace

PoseRecorder::BlockMaker::BlockMaker(int frames, std::size_t joints)
    : frames_(static_cast<std::size_t>(frames)), joints_(joints) {
  worker_ = JoiningThread([this] { work(); });
}

PoseRecorder::BlockMaker::~BlockMaker() {
  state_.store(State::closing);
  state_.notify_all();
}

void PoseRecorder::BlockMaker::work() {
  for (State state = state_.load(); state != State::closing; state = state_.load()) {
    if (state == State::made) {
      state_.wait(State::made);
      continue;
    }
    block_ = Block(frames_, joints_);
    State expected = State::wanted;
    state_.compare_exchange_strong(expected, State::made);
  }
}

PoseRecorder::Block PoseRecorder::BlockMaker::take() {
  if (!made()) return Block(frames_, joints_);
  Block block = std::move(block_);
  state_.store(State::wanted);
  state_.notify_all();
  return block;
}

PoseRecorder::PoseRecorder(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      references_(float_references(required_body(*model_))),
      all_joints_(references_.size()),
      block_frames_(std::max(1, static_cast<int>(std::lround(block_seconds * model_->frame_rate)))),
      most_frames_(static_cast<int>(std::lround(longest_seconds * model_->frame_rate))),
      maker_(block_frames_, references_.size()) {
  std::iota(all_joints_.begin(), all_joints_.end(), 0);
  clear();
}

void PoseRecorder::clear() {
  blocks_.clear();
  blocks_.reserve(static_cast<std::size_t>(most_frames_ / block_frames_ + 1));
  frames_ = 0;
  inputs_wait_ = root_told_ = false;
  pose_ = references_;
  hips_.setZero();
  heading_ = 0;
}

bool PoseRecorder::take(std::span<const float> values, std::span<const int> joints) noexcept {
  if (values.size() != 3 * joints.size() || !all_finite(values)) return false;
  for (std::size_t i = 0; i < joints.size(); ++i)
    pose_[joints[i]] =
        rotation_from<float>(values.subspan(3 * i).first<3>(), references_[joints[i]]);
  return true;
}

bool PoseRecorder::take_pose(std::span<const float> values, double time) noexcept {
  if (full() || !take(values, all_joints_)) return false;
  keep(time);
  return true;
}

bool PoseRecorder::take_outputs(std::span<const float> values, double time) noexcept {
  if (full() || !take(values, model_->body->output_joints)) return false;
  keep(time);
  return true;
}

bool PoseRecorder::take_inputs(std::span<const float> values, double time) noexcept {
  if (full() || values.size() != 3 * model_->body->input_joints.size()) return false;
  if (inputs_wait_) keep(inputs_time_);
  inputs_wait_ = take(values, model_->body->input_joints);
  inputs_time_ = time;
  return inputs_wait_;
}

bool PoseRecorder::take_root(const Eigen::Vector3f& hips, float heading) noexcept {
  if (full() || !hips.allFinite() || !std::isfinite(heading)) return false;
  hips_ = hips;
  heading_ = heading;
  root_told_ = true;
  return true;
}

void PoseRecorder::keep(double time) noexcept {
  const auto row = static_cast<std::size_t>(frames_ % block_frames_);
  if (row == 0) blocks_.push_back(maker_.take());
  Block& block = blocks_.back();
  std::ranges::copy(pose_, block.rotations.begin() + static_cast<int>(row * pose_.size()));
  block.hips[row] = hips_;
  block.heading[row] = heading_;
  inputs_wait_ = false;
  last_time_ = time;
  if (frames_++ == 0) first_time_ = time;
}

PoseRecorder::Recording PoseRecorder::finish() {
  if (inputs_wait_ && !full()) keep(inputs_time_);
  Recording recording;
  recording.model_ = model_;
  recording.blocks_ = std::exchange(blocks_, {});
  recording.block_frames_ = block_frames_;
  recording.frames_ = frames_;
  recording.seconds_ = last_time_ - first_time_;
  recording.root_told_ = root_told_;
  clear();
  return recording;
}

double PoseRecorder::Recording::frame_rate() const {
  const double rate = seconds_ > 0 ? (frames_ - 1) / seconds_ : 0;
  const double against_model = rate / model_->frame_rate;
  // Outside of this the frames came by hand, one by one, or all at once: times say nothing then.
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
    const int frames = std::min(block_frames_, frames_ - motion.frames());
    motion.rotations.insert(motion.rotations.end(), block.rotations.begin(),
                            block.rotations.begin() + frames * motion.joints);
    motion.hips.insert(motion.hips.end(), block.hips.begin(), block.hips.begin() + frames);
    motion.heading.insert(motion.heading.end(), block.heading.begin(),
                          block.heading.begin() + frames);
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
