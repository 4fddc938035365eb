#include "gait/play/input/input_stream.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gait/model/body_pose.h"

namespace gait {

namespace {

bool all_finite(std::span<const float> values) noexcept {
  return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

}  // namespace

InputStream::InputStream(std::shared_ptr<const Model> model, double longest_gap)
    : model_(std::move(model)),
      layout_(StreamLayout::of_inputs(*model_)),
      clock_(model_->frame_rate, layout_.values(StreamKind::rotation) / 3,
             layout_.values(StreamKind::plain), longest_gap),
      missing_(model_->inputs.size(), false),
      collected_(model_->input.values, 0.0f),
      usable_(collected_),
      resampled_(collected_),
      rotations_(layout_.values(StreamKind::rotation) / 3, Eigen::Quaternionf::Identity()),
      plain_(layout_.values(StreamKind::plain), 0.0f) {
  if (model_->body) {
    references_ = float_references(*model_->body);
    heading_.emplace(*model_->body, model_->frame_rate);
    hips_ = layout_.stream_of(body_roles(*model_->body).hips);
  }
}

void InputStream::reset() noexcept {
  clock_.reset();
  if (heading_) heading_->reset();
}

FrameClock::Arrival InputStream::push(double time, std::span<const float> values) noexcept {
  if (values.size() != usable_.size()) return FrameClock::Arrival::rejected;
  hips_world_ = false;
  std::copy(values.begin(), values.end(), collected_.begin());
  return take(time);
}

FrameClock::Arrival InputStream::push_body(double time, std::span<const float> pose) noexcept {
  if (!model_->body || pose.size() != 3 * model_->body->references.size())
    return FrameClock::Arrival::rejected;
  hips_world_ = false;
  for (const StreamPlace& place : layout_)
    if (place.turns())
      std::copy_n(pose.begin() + 3 * place.joint, 3, collected_.begin() + place.begin);
  return take(time);
}

FrameClock::Arrival InputStream::push_collected(double time) noexcept { return take(time); }

bool InputStream::set_values(int stream, std::span<const float> values) noexcept {
  if (!layout_.fits(stream, values)) return false;
  if (stream == hips_) hips_world_ = false;
  std::copy(values.begin(), values.end(), collected_.begin() + first_value(stream));
  return true;
}

bool InputStream::set_rotation(int stream, const Eigen::Quaternionf& rotation) noexcept {
  if (!layout_.has(stream) || layout_[stream].joint < 0) return false;
  const float length = rotation.norm();
  if (!std::isfinite(length) || length < 1e-6f) return false;
  const StreamPlace& place = layout_[stream];
  values_from<float>(rotation.normalized(), references_[place.joint],
                     collected_.data() + place.begin);
  if (stream == hips_) hips_world_ = true;
  return true;
}

bool InputStream::set_euler(int stream, std::string_view order,
                            std::span<const float, 3> degrees) noexcept {
  const auto rotation = rotation_from_euler(order, degrees);
  return rotation && set_rotation(stream, *rotation);
}

FrameClock::Arrival InputStream::take(double time) noexcept {
  // Before anything is held: a stream that goes missing later would keep what is not a number.
  for (int stream = 0; stream < streams(); ++stream)
    if (!missing_[stream] && !layout_.fits(stream, layout_.of(stream, collected_)))
      return FrameClock::Arrival::rejected;
  std::size_t rotation = 0, plain = 0;
  for (int stream = 0; stream < streams(); ++stream) {
    const auto [begin, size, kind, joint] = layout_[stream];
    if (!missing_[stream]) std::copy_n(collected_.begin() + begin, size, usable_.begin() + begin);
    if (kind == StreamKind::rotation)
      rotations_[rotation++] = exponential_map<float>(
          Eigen::Vector3f(usable_[begin], usable_[begin + 1], usable_[begin + 2]));
    else
      for (int i = 0; i < size; ++i) plain_[plain++] = usable_[begin + i];
  }
  const FrameClock::Arrival arrival = clock_.push(time, rotations_, plain_);
  if (arrival != FrameClock::Arrival::rejected) pushed_ = time;
  return arrival;
}

bool InputStream::next() noexcept {
  if (!clock_.next(rotations_, plain_)) return false;
  if (clock_.first_of_run() && heading_) heading_->reset();
  std::size_t rotation = 0, plain = 0;
  for (int stream = 0; stream < streams(); ++stream) {
    const auto [begin, size, kind, joint] = layout_[stream];
    if (kind == StreamKind::plain) {
      for (int i = 0; i < size; ++i) resampled_[begin + i] = plain_[plain++];
      continue;
    }
    Eigen::Quaternionf relative = rotations_[rotation++];
    if (stream == hips_ && hips_world_) {
      const Eigen::Quaternionf& reference = references_[joint];
      const Eigen::Quaternionf hips = reference * relative;
      relative = reference.conjugate() * about_vertical(-heading_->advance(hips)) * hips;
    }
    const Eigen::Vector3f value = rotation_vector<float>(relative);
    std::copy_n(value.data(), 3, resampled_.begin() + begin);
  }
  return true;
}

std::optional<Eigen::Quaternionf> rotation_from_euler(std::string_view order,
                                                      std::span<const float, 3> degrees) noexcept {
  if (order.size() != 3 || !all_finite(degrees)) return std::nullopt;
  Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
  for (int i = 0; i < 3; ++i) {
    const int axis = order[i] == 'X' || order[i] == 'x'   ? 0
                     : order[i] == 'Y' || order[i] == 'y' ? 1
                     : order[i] == 'Z' || order[i] == 'z' ? 2
                                                          : -1;
    if (axis < 0 || (i > 0 && (order[i] | 32) == (order[i - 1] | 32))) return std::nullopt;
    const float angle = degrees[i] * std::numbers::pi_v<float> / 180;
    rotation = rotation * Eigen::AngleAxisf(angle, Eigen::Vector3f::Unit(axis));
  }
  return rotation;
}

}  // namespace gait
