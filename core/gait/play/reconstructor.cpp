#include "gait/play/reconstructor.h"

#include "gait/error.h"
#include "gait/model/body_pose.h"

namespace gait {

namespace {

const Body& body_of(const Model& model) {
  if (!model.body)
    throw Error("model " + model.name +
                ": expected a model of a body; its streams are plain values");
  return *model.body;
}

}  // namespace

Reconstructor::Reconstructor(std::shared_ptr<const Model> model, const PlayerSettings& settings)
    : player_(model, settings),
      clock_(model->frame_rate, static_cast<int>(body_of(*model).input_joints.size())),
      root_(model->body->skeleton, body_roles(*model->body), model->frame_rate),
      hips_heading_(*model->body, model->frame_rate),
      hips_input_(HipsHeading::input_of(*model->body)),
      values_(model->input.values) {
  const Body& body = *model->body;
  for (const auto& reference : body.references) references_.push_back(reference.cast<float>());
  arrived_.assign(body.input_joints.size(), Eigen::Quaternionf::Identity());
  for (std::size_t i = 0; i < arrived_.size(); ++i) arrived_[i] = references_[body.input_joints[i]];
  usable_ = arrived_;
  missing_.assign(arrived_.size(), false);
  ring_.assign(player_.delay() + 2, {0, 0, arrived_});
  pose_ = references_;
}

void Reconstructor::reset(const Eigen::Vector3f& place) noexcept {
  player_.reset();
  clock_.reset();
  root_.reset(place);
  hips_heading_.reset();
  taken_ = made_ = waiting_ = 0;
}

void Reconstructor::set_missing(int input, bool missing) noexcept {
  missing_[input] = missing;
  for (int i = 0; i < 3; ++i) player_.set_missing(3 * input + i, missing);
}

FrameClock::Arrival Reconstructor::push(double time,
                                        std::span<const Eigen::Quaternionf> inputs) noexcept {
  if (inputs.size() != usable_.size()) return FrameClock::Arrival::rejected;
  // Before anything is held: a joint that goes missing later would keep what is not a number.
  for (std::size_t i = 0; i < usable_.size(); ++i)
    if (!missing_[i] && !inputs[i].coeffs().allFinite()) return FrameClock::Arrival::rejected;
  for (std::size_t i = 0; i < usable_.size(); ++i)
    if (!missing_[i]) usable_[i] = inputs[i];
  return clock_.push(time, usable_);
}

void Reconstructor::take() noexcept {
  const Body& body = *player_.model().body;
  Taken& taken = ring_[taken_ % ring_.size()];
  taken.time = clock_.time();
  taken.inputs = arrived_;
  if (hips_input_ >= 0) {
    taken.heading = hips_heading_.advance(arrived_[hips_input_]);
    taken.inputs[hips_input_] = about_vertical(-taken.heading) * arrived_[hips_input_];
  }
  for (std::size_t i = 0; i < taken.inputs.size(); ++i)
    pose_[body.input_joints[i]] = taken.inputs[i];
  pose_vector<float>(pose_, references_, body.input_joints, values_);
  ++taken_;
  player_.advance(values_);
  waiting_ = 0;
}

void Reconstructor::make(int i) noexcept {
  const Model& model = player_.model();
  const Body& body = *model.body;
  const Taken& taken = ring_[made_ % ring_.size()];
  ++made_;
  frame_.time = taken.time;
  frame_.heading = taken.heading;
  frame_.decision = player_.decision(i);
  frame_.styles = player_.styles(i);
  frame_.outputs = player_.output(i);
  for (std::size_t j = 0; j < body.input_joints.size(); ++j)
    pose_[body.input_joints[j]] = taken.inputs[j];
  for (std::size_t j = 0; j < body.output_joints.size(); ++j)
    pose_[body.output_joints[j]] = rotation_from<float>(frame_.outputs.subspan(3 * j).first<3>(),
                                                        references_[body.output_joints[j]]);
  frame_.pose = pose_;
  frame_.hips = root_.advance(pose_, frame_.heading);
}

bool Reconstructor::next() noexcept {
  while (waiting_ >= player_.available()) {
    if (!clock_.next(arrived_)) return false;
    // Time jumped: what came before does not belong to the same motion.
    if (clock_.first_of_run() && taken_ > 0) {
      player_.reset();
      hips_heading_.reset();
      root_.reset(root_.position());
      made_ = taken_;
    }
    take();
  }
  make(waiting_++);
  return true;
}

bool Reconstructor::flush() noexcept {
  if (waiting_ >= player_.available()) {
    waiting_ = 0;
    if (!player_.flush()) return false;
  }
  make(waiting_++);
  return true;
}

}  // namespace gait
