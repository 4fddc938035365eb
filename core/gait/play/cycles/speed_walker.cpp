#include "gait/play/cycles/speed_walker.h"

#include <algorithm>
#include <cmath>

#include "gait/motion/smoothing.h"

namespace gait {

namespace {

constexpr float shortest_leg = 0.3f, longest_leg = 1.5f;  // metres
constexpr double longest_frame = 0.25;                    // seconds
constexpr float seconds_of_change = 0.7f;                 // of subject or law: about a step
constexpr float highest_cadence = 8;                      // steps per second
constexpr float leg_growth = 0.4f;                        // metres per second
// People start and stop within two steps, about 1 m/s².
constexpr float most_gain = 0.9f;               // pace per second
constexpr float seconds_to_gain = 0.1f;         // until the gain itself is reached
constexpr float seconds_to_arrive = 0.25f;      // the last of a change of speed fades over this
constexpr float arrived = 1e-3f;                // pace
constexpr float least_pace = 1e-3f;             // of one who does not stand
constexpr float pace_per_speed = stride_power;  // as steep as the share of stride where they meet
// A walk begins with the right foot about to pass the left one.
constexpr double first_phase = 0.7;

float towards(float from, float to, float most) noexcept {
  return from + std::clamp(to - from, -most, most);
}

// How freely the stride may change: while one foot swings, it alone takes the change; while both
// stand, one would slide. Never quite nothing, or a slow walk could not change.
float freedom(double phase) noexcept {
  const float step = static_cast<float>(2 * phase - std::floor(2 * phase));
  return 0.2f + 0.8f * smoothstep(0.15f, 0.35f, step) * (1 - smoothstep(0.88f, 1.f, step));
}

}  // namespace

SpeedWalker::SpeedWalker(std::shared_ptr<const SpeedTables> tables)
    : tables_(std::move(tables)),
      reader_(*tables_),
      weights_(tables_->subjects.size(), 1.f / static_cast<float>(tables_->subjects.size())),
      wanted_weights_(weights_),
      pose_(tables_->references.size()) {
  settle();
}

ControlResult SpeedWalker::set_speed(float metres_per_second) noexcept {
  if (!std::isfinite(metres_per_second)) return ControlResult::refused;
  wanted_speed_ = std::clamp(metres_per_second, 0.f, highest_speed);
  const bool too_fast_for_legs =
      wanted_leg_length_ > 0 && wanted_speed_ > highest_speed_per_leg * wanted_leg_length_;
  return wanted_speed_ == metres_per_second && !too_fast_for_legs ? ControlResult::as_given
                                                                  : ControlResult::clamped;
}

ControlResult SpeedWalker::set_leg_length(float metres) noexcept {
  if (!std::isfinite(metres)) return ControlResult::refused;
  wanted_leg_length_ = std::clamp(metres, shortest_leg, longest_leg);
  return wanted_leg_length_ == metres ? ControlResult::as_given : ControlResult::clamped;
}

void SpeedWalker::set_own_leg_length() noexcept { wanted_leg_length_ = 0; }

ControlResult SpeedWalker::set_weights(std::span<const float> weights) noexcept {
  if (weights.size() != wanted_weights_.size()) return ControlResult::refused;
  double sum = 0;
  for (const float weight : weights) {
    if (!std::isfinite(weight) || weight < 0) return ControlResult::refused;
    sum += weight;
  }
  if (!(sum > 0)) return ControlResult::refused;
  for (std::size_t i = 0; i < weights.size(); ++i)
    wanted_weights_[i] = static_cast<float>(weights[i] / sum);
  return ControlResult::as_given;
}

ControlResult SpeedWalker::set_subject(std::string_view subject) noexcept {
  const auto& subjects = tables_->subjects;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    if (subjects[i].subject != subject) continue;
    std::fill(wanted_weights_.begin(), wanted_weights_.end(), 0.f);
    wanted_weights_[i] = 1;
    return ControlResult::as_given;
  }
  return ControlResult::refused;
}

void SpeedWalker::set_law(SpeedLaw law) noexcept { law_ = law; }

ControlResult SpeedWalker::set_cadence(float steps_per_second) noexcept {
  if (!std::isfinite(steps_per_second)) return ControlResult::refused;
  cadence_ = std::clamp(steps_per_second, 0.f, highest_cadence);
  return cadence_ == steps_per_second ? ControlResult::as_given : ControlResult::clamped;
}

bool SpeedWalker::scrub(double phase) noexcept {
  if (!(phase >= 0 && phase < 1)) return false;
  phase_ = phase;
  contact_.reset();
  read_pose();
  return true;
}

void SpeedWalker::settle() noexcept {
  change_subjects(1);
  change_leg_length(longest_leg);
  change_law(1);
  if (standing()) phase_ = first_phase;
  speed_per_leg_ = wanted_speed_per_leg();
  gaining_ = 0;
  frequency_ = 0;
  read_pose();
}

void SpeedWalker::reset() noexcept {
  contact_.reset();
  speed_per_leg_ = gaining_ = frequency_ = 0;
  phase_ = first_phase;
  read_pose();
}

void SpeedWalker::advance(double seconds) noexcept {
  if (!(seconds > 0) || !std::isfinite(seconds)) return;
  seconds = std::min(seconds, longest_frame);
  const auto dt = static_cast<float>(seconds);
  change_subjects(dt / seconds_of_change);
  change_leg_length(dt * leg_growth);
  change_law(dt / seconds_of_change);
  change_speed(dt);
  frequency_ = 0;
  if (speed_per_leg_ > 0)
    for (const SpeedLaw law : {SpeedLaw::fitted, SpeedLaw::inman, SpeedLaw::feet})
      if (const float weight = laws_[static_cast<std::size_t>(law)]; weight > 0)
        frequency_ += weight * frequency_by(law);
  if (cadence_ > 0 && !standing()) frequency_ = 0.5f * cadence_;
  const double before = phase_;
  phase_ += seconds * frequency_;  // eq. 5
  contact_.reset();
  if (phase_ >= 1)
    contact_ = Foot::right;
  else if (before < 0.5 && phase_ >= 0.5)
    contact_ = Foot::left;
  phase_ -= std::floor(phase_);
  read_pose();
}

float SpeedWalker::wanted_speed_per_leg() const noexcept {
  return std::min(wanted_speed_ / leg_length_, highest_speed_per_leg);
}

void SpeedWalker::change_subjects(float most) noexcept {
  float sum = 0;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    weights_[i] = towards(weights_[i], wanted_weights_[i], most);
    sum += weights_[i];
  }
  for (float& weight : weights_) weight /= sum;
}

void SpeedWalker::change_leg_length(float most) noexcept {
  float wanted = wanted_leg_length_;
  if (!(wanted > 0))
    for (std::size_t i = 0; i < weights_.size(); ++i)
      wanted += weights_[i] * tables_->subjects[i].leg_length;
  leg_length_ = leg_length_ > 0 ? towards(leg_length_, wanted, most) : wanted;
}

void SpeedWalker::change_law(float most) noexcept {
  float sum = 0;
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    laws_[i] = towards(laws_[i], i == static_cast<std::size_t>(law_) ? 1.f : 0.f, most);
    sum += laws_[i];
  }
  for (float& law : laws_) law /= sum;
}

float SpeedWalker::slowest() const noexcept {
  float sum = 0;
  for (std::size_t i = 0; i < weights_.size(); ++i)
    sum += weights_[i] * tables_->subjects[i].slowest;
  return sum;
}

// Pace: the share of the stride below the slowest captured speed, and on from there as smoothly. It
// is pace that changes at a limited rate, so that a pose leaves standing and comes to it evenly.
float SpeedWalker::pace_of(float speed_per_leg) const noexcept {
  const float least = slowest();
  return speed_per_leg < least ? share_of_stride(speed_per_leg, least)
                               : 1 + pace_per_speed * (speed_per_leg / least - 1);
}

float SpeedWalker::speed_of_pace(float pace) const noexcept {
  const float least = slowest();
  return pace < 1 ? speed_of_share(pace, least) : least * (1 + (pace - 1) / pace_per_speed);
}

void SpeedWalker::change_speed(float seconds) noexcept {
  const float wanted_speed = wanted_speed_per_leg();
  const float pace = pace_of(speed_per_leg_);
  const float missing = pace_of(wanted_speed) - pace;
  if (std::abs(missing) < arrived) {
    speed_per_leg_ = wanted_speed;
    gaining_ = 0;
    return;
  }
  if (standing()) phase_ = first_phase;
  const float gain = std::clamp(missing / seconds_to_arrive, -most_gain, most_gain);
  gaining_ += (gain - gaining_) * first_order_gain(seconds, seconds_to_gain);
  const float change = gaining_ * freedom(phase_) * seconds;
  // Not past what is wanted, whatever gain is left.
  const bool there = (missing > 0) == (change > 0) && std::abs(change) >= std::abs(missing);
  speed_per_leg_ = there ? wanted_speed : speed_of_pace(std::max(least_pace, pace + change));
}

float SpeedWalker::frequency_by(SpeedLaw law) const noexcept {
  if (law == SpeedLaw::inman) return 0.743f * std::sqrt(speed_per_leg_);
  float sum = 0;
  if (law == SpeedLaw::feet) {
    for (std::size_t i = 0; i < weights_.size(); ++i)
      if (weights_[i] > 0) sum += weights_[i] * stride_at(tables_->subjects[i], speed_per_leg_);
    return speed_per_leg_ / sum;
  }
  for (std::size_t i = 0; i < weights_.size(); ++i)
    if (weights_[i] > 0)
      sum += weights_[i] * tables_->subjects[i].frequency_scale *
             std::pow(speed_per_leg_, tables_->subjects[i].frequency_power);
  return sum;
}

void SpeedWalker::read_pose() noexcept {
  reader_.clear();
  reader_.set_phase(phase_);
  for (std::size_t i = 0; i < weights_.size(); ++i)
    if (weights_[i] > 0)
      reader_.add(cycles_around(tables_->subjects[i], speed_per_leg_), weights_[i]);
  reader_.read(pose_);
}

}  // namespace gait
