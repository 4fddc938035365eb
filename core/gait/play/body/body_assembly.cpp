#include "gait/play/body/body_assembly.h"

#include <algorithm>

#include "gait/motion/finite.h"

namespace gait {

namespace {

bool usable(std::span<const float> values, Eigen::Index size) noexcept {
  return static_cast<Eigen::Index>(values.size()) == size && all_finite(values);
}

// The values of a frame's rotations, to where a whole pose has their joints.
void place(const StreamLayout& layout, std::span<const float> values,
           Eigen::VectorXf& pose) noexcept {
  for (const StreamPlace& stream : layout)
    if (stream.joint >= 0)
      std::copy_n(values.data() + stream.begin, 3, pose.data() + 3 * stream.joint);
}

// Three values per joint: the mean pose of training, the references where nothing is known.
Eigen::VectorXf mean_pose(const Model& model) {
  return Eigen::VectorXf::Zero(3 * model.body->skeleton.size());
}

}  // namespace

BodyAssembly::BodyAssembly(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      inputs_(StreamLayout::of_inputs(*model_)),
      outputs_(StreamLayout::of_outputs(*model_)),
      measured_(mean_pose(*model_)),
      hand_over_(StreamLayout::of_body(*model_->body), model_->frame_rate),
      stored_(mean_pose(*model_)),
      taken_(stored_),
      shown_(stored_),
      before_(stored_) {}

void BodyAssembly::reset() noexcept {
  measured_.reset();
  hand_over_.stop();
  source_ = Source::none;
  shown_frames_ = 0;
  stored_.setZero();
}

bool BodyAssembly::store_inputs(std::span<const float> values) noexcept {
  if (!usable(values, model_->input.values)) return false;
  place(inputs_, values, stored_);
  measured_.store({stored_.data(), static_cast<std::size_t>(stored_.size())});
  return true;
}

bool BodyAssembly::store_pose(std::span<const float> values) noexcept {
  if (!usable(values, stored_.size())) return false;
  std::ranges::copy(values, stored_.data());
  measured_.store(values);
  return true;
}

bool BodyAssembly::take_outputs(std::span<const float> values) noexcept {
  if (!usable(values, model_->output.values)) return false;
  measured_.mark();
  std::ranges::copy(measured_.at(delay_), taken_.data());
  place(outputs_, values, taken_);
  show(Source::parts);
  return true;
}

bool BodyAssembly::take_pose(std::span<const float> values) noexcept {
  if (!usable(values, taken_.size())) return false;
  measured_.mark();
  std::ranges::copy(values, taken_.data());
  show(Source::whole);
  return true;
}

void BodyAssembly::show(Source source) noexcept {
  if (source != source_ && source_ != Source::none) {
    if (shown_frames_ > 1)
      hand_over_.begin_before(shown_, before_, taken_);
    else
      hand_over_.begin(shown_, taken_);
  }
  source_ = source;
  shown_frames_ = std::min(shown_frames_ + 1, 2);
  before_.swap(shown_);
  shown_ = taken_;
  hand_over_.apply(shown_);
}

}  // namespace gait
