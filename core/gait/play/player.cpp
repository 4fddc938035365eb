#include "gait/play/player.h"

#include <algorithm>
#include <cmath>

namespace gait {

namespace {

int frames_in(double seconds, double frame_rate) {
  return std::max(0, static_cast<int>(std::lround(seconds * frame_rate)));
}

Trajectory trajectory_for(const Model& model, const PlayerSettings& settings) {
  return Trajectory(
      model.output.statics(), settings.past.value_or(frames_in(model.play.past, model.frame_rate)),
      settings.current, settings.future.value_or(frames_in(model.play.future, model.frame_rate)));
}

}  // namespace

Player::Player(const PlayModel& played_model, const PlayerSettings& settings)
    : recogniser_(played_model, settings),
      map_(recogniser_.model(), recogniser_.tables()),
      trajectory_(trajectory_for(recogniser_.model(), settings)) {
  const Model& played = recogniser_.model();
  if (settings.strength) map_.set_strength(static_cast<float>(*settings.strength));
  const int waiting = trajectory_.delay() + 1;
  Held empty;
  empty.styles.assign(played.styles.size(), 0.0f);
  ring_.assign(waiting + 1, empty);
  output_slots_.assign(waiting, 0);
  outputs_ = played.output_mean.cast<float>().replicate(1, waiting);
}

void Player::reset() noexcept {
  recogniser_.reset();
  trajectory_.reset();
  mapped_ = emitted_ = available_ = 0;
}

std::span<const float> Player::output(int i) const noexcept {
  return {outputs_.col(i).data(), static_cast<std::size_t>(outputs_.rows())};
}
const Decision& Player::decision(int i) const noexcept { return ring_[output_slots_[i]].decision; }
std::span<const float> Player::styles(int i) const noexcept {
  return ring_[output_slots_[i]].styles;
}

void Player::advance(std::span<const float> values) noexcept {
  available_ = 0;
  if (recogniser_.advance(values)) map_decided();
}

void Player::map_decided() noexcept {
  Held& held = ring_[slot(mapped_)];
  held.decision = recogniser_.decision();
  const auto styles = recogniser_.styles();
  std::copy(styles.begin(), styles.end(), held.styles.begin());
  map_.use(recogniser_.tables());
  trajectory_.push(map_.map(recogniser_.states(), recogniser_.scaled(), recogniser_.known()));
  ++mapped_;
  if (trajectory_.ready()) emit(trajectory_.generate());
}

void Player::emit(const Eigen::Ref<const Eigen::MatrixXf>& statics) noexcept {
  const std::vector<int>& modelled = recogniser_.model().output.modelled;
  for (Eigen::Index i = 0; i < statics.cols(); ++i) {
    for (Eigen::Index value = 0; value < statics.rows(); ++value)
      outputs_(modelled[static_cast<std::size_t>(value)], available_) = statics(value, i);
    output_slots_[available_++] = slot(emitted_);
    ++emitted_;
  }
}

bool Player::flush() noexcept {
  available_ = 0;
  while (available_ == 0 && recogniser_.flush()) map_decided();
  if (available_ == 0 && emitted_ < mapped_) emit(trajectory_.flush(mapped_ - emitted_));
  return available_ > 0;
}

}  // namespace gait
