#include "gait/play/synthesise/stream_controls.h"

#include <algorithm>
#include <cmath>

namespace gait {

namespace {

constexpr float largest_scale = 10;

}  // namespace

StreamControls::StreamControls(const StreamLayout& layout)
    : layout_(layout),
      controls_(static_cast<std::size_t>(layout.streams())),
      shifts_(static_cast<std::size_t>(layout.values()), Glide(0)),
      places_(shifts_) {}

bool StreamControls::set_scale(int stream, float scale) noexcept {
  if (!layout_.has(stream) || !std::isfinite(scale)) return false;
  controls_[stream].scale.set(std::clamp(scale, -largest_scale, largest_scale));
  at_rest_ = neutral_ = false;
  return true;
}

bool StreamControls::set_shift(int stream, std::span<const float> by) noexcept {
  if (!layout_.fits(stream, by)) return false;
  for (std::size_t i = 0; i < by.size(); ++i) shifts_[layout_[stream].begin + i].set(by[i]);
  at_rest_ = neutral_ = false;
  return true;
}

bool StreamControls::fix(int stream, std::span<const float> at) noexcept {
  if (!layout_.fits(stream, at)) return false;
  Control& control = controls_[stream];
  for (std::size_t i = 0; i < at.size(); ++i) {
    Glide& place = places_[layout_[stream].begin + i];
    place.set(at[i]);
    // Not fixed yet: nothing can jump, and it shall not come from where it was fixed last.
    if (control.fixed.value() == 0) place.arrive();
  }
  control.fixed.set(1);
  at_rest_ = neutral_ = false;
  return true;
}

bool StreamControls::free(int stream) noexcept {
  if (!layout_.has(stream)) return false;
  controls_[stream].scale.set(1), controls_[stream].fixed.set(0);
  for (int i = 0; i < layout_[stream].size; ++i) shifts_[layout_[stream].begin + i].set(0);
  at_rest_ = neutral_ = false;
  return true;
}

// Most streams are left alone most of the time.
void StreamControls::note_rest() noexcept {
  const auto arrived = [](const Glide& glide) { return glide.arrived(); };
  const auto zero = [](const Glide& glide) { return glide.value() == 0; };
  at_rest_ = std::ranges::all_of(controls_,
                                 [](const Control& control) {
                                   return control.scale.arrived() && control.fixed.arrived();
                                 }) &&
             std::ranges::all_of(shifts_, arrived) && std::ranges::all_of(places_, arrived);
  neutral_ = at_rest_ && std::ranges::all_of(shifts_, zero) &&
             std::ranges::all_of(controls_, [](const Control& control) {
               return control.scale.value() == 1 && control.fixed.value() == 0;
             });
}

void StreamControls::advance(float steps) noexcept {
  if (at_rest_) return;
  const float share = glide_share(steps, 1);
  for (Control& control : controls_) control.scale.advance(share), control.fixed.advance(share);
  for (Glide& shift : shifts_) shift.advance(share);
  for (Glide& place : places_) place.advance(share);
  note_rest();
}

void StreamControls::arrive() noexcept {
  for (Control& control : controls_) control.scale.arrive(), control.fixed.arrive();
  for (Glide& shift : shifts_) shift.arrive();
  for (Glide& place : places_) place.arrive();
  note_rest();
}

void StreamControls::apply(const Eigen::VectorXf& means,
                           Eigen::Ref<Eigen::VectorXf> values) const noexcept {
  if (neutral_) return;
  for (int stream = 0; stream < layout_.streams(); ++stream) {
    const Control& control = controls_[stream];
    const StreamPlace& place = layout_[stream];
    for (int i = place.begin; i < place.begin + place.size; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const float free =
          values[i] + (control.scale.value() - 1) * (values[i] - means[i]) + shifts_[at].value();
      values[i] = free + control.fixed.value() * (places_[at].value() - free);
    }
  }
}

void StreamControls::take_over(const StreamControls& other) noexcept {
  if (controls_.size() == other.controls_.size()) controls_ = other.controls_;
  shifts_ = other.shifts_;
  places_ = other.places_;
  at_rest_ = other.at_rest_, neutral_ = other.neutral_;
}

}  // namespace gait
