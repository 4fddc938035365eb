#include "gait/play/recognise/live_recogniser.h"

#include "gait/motion/smoothing.h"

namespace gait {

namespace {
constexpr double strange_seconds = 0.3;  // over which distances are averaged
}

float unlikeness(float distance, float usual) noexcept {
  if (!(distance > 0)) return 0;
  const float ratio = usual / distance;
  return 1 / (1 + ratio * ratio * ratio);
}

LiveRecogniser::LiveRecogniser(const PlayModel& played, const RecogniserSettings& settings,
                               double longest_gap)
    : stream_(played.model, longest_gap),
      recogniser_(played, settings),
      standing_(*played.model),
      choice_(played.model->frame_rate),
      forget_(first_order_gain(1 / played.model->frame_rate, strange_seconds)) {}

void LiveRecogniser::begin_anew() noexcept {
  recogniser_.reset();
  standing_.reset();
  choice_.reset();
  next_is_first_ = true;
}

void LiveRecogniser::reset() noexcept {
  stream_.reset();
  begin_anew();
}

void LiveRecogniser::set_missing(int stream, bool missing) noexcept {
  stream_.set_missing(stream, missing);
  const int begin = stream_.first_value(stream);
  for (int i = 0; i < recogniser_.model().inputs[stream].size; ++i) {
    recogniser_.set_missing(begin + i, missing);
    standing_.set_missing(begin + i, missing);
  }
}

bool LiveRecogniser::next() noexcept {
  while (stream_.next()) {
    if (stream_.first_of_run()) begin_anew();
    if (advance(stream_.values())) return true;
  }
  return false;
}

bool LiveRecogniser::advance(std::span<const float> values) noexcept {
  recogniser_.set_walking(standing_.advance(values));
  if (!recogniser_.advance(values)) return false;
  note_decided();
  return true;
}

bool LiveRecogniser::flush() noexcept {
  if (!recogniser_.flush()) return false;
  note_decided();
  return true;
}

void LiveRecogniser::note_decided() noexcept {
  first_ = next_is_first_;
  next_is_first_ = false;
  choice_.advance(recogniser_.styles());
  const float now = recogniser_.decision().distance;
  if (first_) distance_ = now;
  distance_ += forget_ * (now - distance_);
}

}  // namespace gait
