#include "gait/play/stream_reconstructor.h"

#include <algorithm>

namespace gait {

namespace {

// For so long after a stream begins, the synthesiser gets the place of its walk with each frame: a
// synthesiser that walks alone falls in step with it meanwhile.
constexpr double falling_in_seconds = 2;

}  // namespace

StreamReconstructor::StreamReconstructor(const PlayModel& played, const PlaySettings& settings)
    : recogniser_(played, settings),
      map_(played),
      synthesiser_(played,
                   {settings.past, settings.future, settings.current, settings.walks_alone}),
      walks_alone_(settings.walks_alone) {
  const Model& model = *played.model;
  if (settings.on_stage && model.body) {
    stage_.emplace(played.model);
    stage_->set_watched(false);
  }
  if (settings.strength) map_.set_strength(static_cast<float>(*settings.strength));
  Taken empty;
  empty.inputs.assign(model.input.values, 0.0f);
  empty.styles.assign(model.styles.size(), 0.0f);
  ring_.assign(delay() + 2, empty);
}

int StreamReconstructor::delay() const noexcept {
  return recogniser_.recogniser().lag() + synthesiser_.delay();
}

void StreamReconstructor::reset(const Eigen::Vector3f& place) noexcept {
  recogniser_.reset();
  synthesiser_.reset();
  if (stage_) {
    stage_->set_place(place);
    stage_->reset();
  }
  taken_ = decided_ = places_ = 0;
  whole_ = false;
}

// The frame that comes next belongs to another motion.
void StreamReconstructor::begin_anew() noexcept {
  recogniser_.begin_anew();
  taken_ = decided_;
  places_ = 0;
  if (walks_alone_) return;
  synthesiser_.reset();
  if (stage_) stage_->begin_anew();
}

FrameClock::Arrival StreamReconstructor::push(
    double time, std::span<const Eigen::Quaternionf> rotations) noexcept {
  InputStream& input = stream();
  if (static_cast<int>(rotations.size()) != input.streams()) return FrameClock::Arrival::rejected;
  for (int i = 0; i < input.streams(); ++i)
    if (!input.set_rotation(i, rotations[i]) && !input.missing(i))
      return FrameClock::Arrival::rejected;
  return input.push_collected(time);
}

bool StreamReconstructor::next() noexcept {
  InputStream& input = stream();
  while (input.next()) {
    if (input.first_of_run()) begin_anew();
    if (take(input.time(), input.heading(), input.values())) return true;
  }
  return false;
}

bool StreamReconstructor::advance(std::span<const float> values) noexcept {
  return take(taken_ / model().frame_rate, std::nullopt, values);
}

bool StreamReconstructor::take(double time, std::optional<float> heading,
                               std::span<const float> values) noexcept {
  Taken& frame = taken(taken_++);
  frame.time = time;
  frame.heading = heading;
  std::ranges::copy(values, frame.inputs.begin());
  return recogniser_.advance(values) && map_decided();
}

// Maps the frame that was decided on. True when a frame was made.
bool StreamReconstructor::map_decided() noexcept {
  const Recogniser& decided = recogniser_.recogniser();
  Taken& frame = taken(decided_++);
  frame.decision = decided.decision();
  std::ranges::copy(decided.styles(), frame.styles.begin());
  if (walks_alone_) {
    synthesiser_.set_walking(recogniser_.walking());
    if (places_ < falling_in_seconds * model().frame_rate) ++places_, tell_place();
  }
  map_.map(decided);
  if (!synthesiser_.push(map_.mean(), map_.variance())) return false;
  make();
  return true;
}

void StreamReconstructor::tell_place() noexcept {
  const Recogniser& decided = recogniser_.recogniser();
  synthesiser_.set_place(decided.decision().phase, decided.decision().cadence, decided.styles());
}

bool StreamReconstructor::flush() noexcept {
  while (recogniser_.flush())
    if (map_decided()) return true;
  if (!synthesiser_.flush()) return false;
  make();
  return true;
}

void StreamReconstructor::lose() noexcept {
  tell_place();
  recogniser_.reset();
  taken_ = decided_;
  places_ = 0;
}

bool StreamReconstructor::go_on() noexcept {
  if (!synthesiser_.go_on()) return false;
  make();
  return true;
}

void StreamReconstructor::make() noexcept {
  const Taken& of = taken(std::max(0, decided_ - 1 - synthesiser_.held()));
  frame_.time = of.time;
  frame_.decision = of.decision;
  frame_.styles = of.styles;
  frame_.outputs = synthesiser_.outputs();
  frame_.heading = of.heading.value_or(0.0f);
  if (!stage_) return;
  // A body that comes to rest does so with the joints that were shown.
  if (synthesiser_.walks() || !synthesiser_.alone()) whole_ = synthesiser_.walks();
  if (of.heading) stage_->set_heading(*of.heading);
  if (whole_) {
    stage_->show_pose(synthesiser_.pose());
  } else {
    stage_->store_inputs(of.inputs);
    stage_->show_outputs(frame_.outputs);
  }
  frame_.pose = stage_->rotations();
  frame_.heading = stage_->root().heading;
  frame_.hips = stage_->root().hips;
}

}  // namespace gait
