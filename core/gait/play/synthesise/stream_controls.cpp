#include "gait/play/synthesise/stream_controls.h"

#include <algorithm>
#include <cmath>

namespace gait {

namespace {

constexpr float largest_scale = 10;

}  // namespace

StreamControls::StreamControls(const std::vector<Stream>& streams) {
  for (const Stream& stream : streams) {
    Control control;
    control.begin = values_;
    control.size = stream.size;
    values_ += stream.size;
    controls_.push_back(control);
  }
  shifts_.assign(static_cast<std::size_t>(values_), Glide(0));
  places_ = shifts_;
}

bool StreamControls::fits(int stream, std::span<const float> values) const noexcept {
  return stream >= 0 && stream < static_cast<int>(controls_.size()) &&
         static_cast<int>(values.size()) == controls_[stream].size &&
         std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

bool StreamControls::set_scale(int stream, float scale) noexcept {
  if (stream < 0 || stream >= static_cast<int>(controls_.size()) || !std::isfinite(scale))
    return false;
  controls_[stream].scale.set(std::clamp(scale, -largest_scale, largest_scale));
  return true;
}

bool StreamControls::set_shift(int stream, std::span<const float> by) noexcept {
  if (!fits(stream, by)) return false;
  for (std::size_t i = 0; i < by.size(); ++i) shifts_[controls_[stream].begin + i].set(by[i]);
  return true;
}

bool StreamControls::fix(int stream, std::span<const float> at) noexcept {
  if (!fits(stream, at)) return false;
  Control& control = controls_[stream];
  for (std::size_t i = 0; i < at.size(); ++i) {
    Glide& place = places_[control.begin + i];
    place.set(at[i]);
    // Not fixed yet: nothing can jump, and it shall not come from where it was fixed last.
    if (control.fixed.value() == 0) place.arrive();
  }
  control.fixed.set(1);
  return true;
}

bool StreamControls::free(int stream) noexcept {
  if (stream < 0 || stream >= static_cast<int>(controls_.size())) return false;
  Control& control = controls_[stream];
  control.scale.set(1), control.fixed.set(0);
  for (int i = 0; i < control.size; ++i) shifts_[control.begin + i].set(0);
  return true;
}

void StreamControls::advance(float steps) noexcept {
  const float share = glide_share(steps, 1);
  for (Control& control : controls_) control.scale.advance(share), control.fixed.advance(share);
  for (Glide& shift : shifts_) shift.advance(share);
  for (Glide& place : places_) place.advance(share);
}

void StreamControls::arrive() noexcept {
  for (Control& control : controls_) control.scale.arrive(), control.fixed.arrive();
  for (Glide& shift : shifts_) shift.arrive();
  for (Glide& place : places_) place.arrive();
}

void StreamControls::apply(const Eigen::VectorXf& means,
                           Eigen::Ref<Eigen::VectorXf> values) const noexcept {
  for (const Control& control : controls_)
    for (int i = control.begin; i < control.begin + control.size; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const float free =
          values[i] + (control.scale.value() - 1) * (values[i] - means[i]) + shifts_[at].value();
      values[i] = free + control.fixed.value() * (places_[at].value() - free);
    }
}

void StreamControls::take_over(const StreamControls& other) noexcept {
  for (std::size_t i = 0; i < controls_.size(); ++i) {
    controls_[i].scale = other.controls_[i].scale;
    controls_[i].fixed = other.controls_[i].fixed;
  }
  shifts_ = other.shifts_;
  places_ = other.places_;
}

}  // namespace gait
