#include "gait/play/input/input_stream.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gait/model/body_pose.h"
#include "gait/motion/finite.h"

namespace gait {

InputStream::InputStream(std::shared_ptr<const Model> model, double longest_gap)
    : model_(std::move(model)),
      layout_(StreamLayout::of_inputs(*model_)),
      clock_(model_->frame_rate, layout_.values(StreamKind::rotation) / 3,
             layout_.values(StreamKind::plain), longest_gap),
      missing_(model_->inputs.size(), false),
      collected_{std::vector<Eigen::Quaternionf>(layout_.values(StreamKind::rotation) / 3,
                                                 Eigen::Quaternionf::Identity()),
                 std::vector<float>(layout_.values(StreamKind::plain), 0.0f)},
      usable_(collected_),
      due_(collected_),
      resampled_(model_->input.values, 0.0f) {
  int rotation = 0, plain = 0;
  for (const StreamPlace& stream : layout_) {
    index_.push_back(stream.turns() ? rotation++ : plain);
    if (!stream.turns()) plain += stream.size;
  }
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

void InputStream::collect(int stream, const float* values) noexcept {
  if (layout_[stream].turns())
    collected_.rotations[index_[stream]] =
        exponential_map<float>(Eigen::Vector3f(values[0], values[1], values[2]));
  else
    std::copy_n(values, layout_[stream].size, collected_.plain.begin() + index_[stream]);
}

FrameClock::Arrival InputStream::push(double time, std::span<const float> values) noexcept {
  if (values.size() != resampled_.size()) return FrameClock::Arrival::rejected;
  hips_world_ = false;
  for (int stream = 0; stream < streams(); ++stream)
    collect(stream, &values[layout_[stream].begin]);
  return push_collected(time);
}

FrameClock::Arrival InputStream::push_body(double time, std::span<const float> pose) noexcept {
  if (!model_->body || pose.size() != 3 * model_->body->references.size())
    return FrameClock::Arrival::rejected;
  hips_world_ = false;
  for (int stream = 0; stream < streams(); ++stream)
    if (layout_[stream].turns()) collect(stream, &pose[3 * layout_[stream].joint]);
  return push_collected(time);
}

bool InputStream::set_values(int stream, std::span<const float> values) noexcept {
  if (!layout_.fits(stream, values)) return false;
  if (stream == hips_) hips_world_ = false;
  collect(stream, values.data());
  return true;
}

bool InputStream::set_rotation(int stream, const Eigen::Quaternionf& rotation) noexcept {
  if (!layout_.has(stream) || layout_[stream].joint < 0) return false;
  const float length = rotation.norm();
  if (!std::isfinite(length) || length < 1e-6f) return false;
  // What is of length 1 but for rounding keeps its last digits.
  const bool unit = std::abs(length - 1) < 1e-6f;
  collected_.rotations[index_[stream]] =
      references_[layout_[stream].joint].conjugate() * (unit ? rotation : rotation.normalized());
  if (stream == hips_) hips_world_ = true;
  return true;
}

bool InputStream::set_euler(int stream, std::string_view order,
                            std::span<const float, 3> degrees) noexcept {
  const auto rotation = rotation_from_euler(order, degrees);
  return rotation && set_rotation(stream, *rotation);
}

FrameClock::Arrival InputStream::push_collected(double time) noexcept {
  // Before anything is held: a stream that goes missing later would keep what is not a number.
  for (int stream = 0; stream < streams(); ++stream) {
    if (missing_[stream]) continue;
    const bool finite =
        layout_[stream].turns()
            ? collected_.rotations[index_[stream]].coeffs().allFinite()
            : all_finite(std::span(collected_.plain).subspan(index_[stream], layout_[stream].size));
    if (!finite) return FrameClock::Arrival::rejected;
  }
  for (int stream = 0; stream < streams(); ++stream) {
    if (missing_[stream]) continue;
    const int index = index_[stream];
    if (layout_[stream].turns())
      usable_.rotations[index] = collected_.rotations[index];
    else
      std::copy_n(collected_.plain.begin() + index, layout_[stream].size,
                  usable_.plain.begin() + index);
  }
  const FrameClock::Arrival arrival = clock_.push(time, usable_.rotations, usable_.plain);
  if (arrival != FrameClock::Arrival::rejected) pushed_ = time;
  return arrival;
}

bool InputStream::next() noexcept {
  if (!clock_.next(due_.rotations, due_.plain)) return false;
  if (clock_.first_of_run() && heading_) heading_->reset();
  heading_out_.reset();
  for (int stream = 0; stream < streams(); ++stream) {
    float* const values = &resampled_[layout_[stream].begin];
    if (!layout_[stream].turns()) {
      std::copy_n(due_.plain.begin() + index_[stream], layout_[stream].size, values);
      continue;
    }
    Eigen::Quaternionf relative = due_.rotations[index_[stream]];
    if (stream == hips_ && hips_world_) {
      const Eigen::Quaternionf& reference = references_[layout_[stream].joint];
      const Eigen::Quaternionf hips = reference * relative;
      heading_out_ = heading_->advance(hips);
      relative = reference.conjugate() * about_vertical(-*heading_out_) * hips;
    }
    const Eigen::Vector3f value = rotation_vector<float>(relative);
    std::copy_n(value.data(), 3, values);
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
