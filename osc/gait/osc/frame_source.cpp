#include "gait/osc/frame_source.h"

#include <algorithm>
#include <utility>

#include "gait/osc/forms.h"

namespace gait::osc {

void FrameSource::begin(const MocapEvent& event) noexcept {
  used_ = true;
  hopping_ = clocked_ = any_told_ = false;
  again_ = true;
  first_ = seen_ = event.time;
  bones_since_ = event.time;
  edge_seen_ = -1e9;
  frames_ = frames_of_port_ = values_ = 0;
  ports_.fill(0);
  bones_.reset();
  bones_before_.reset();
  frame_.form = event.form;
  frame_.sender = event.sender;
  frame_.stream = event.stream;
  frame_.joints = 0;
  frame_.begin(event.time);
}

void FrameSource::change_port(const MocapEvent& event, bool again) noexcept {
  std::rotate(ports_.begin(), ports_.end() - 1, ports_.end());
  ports_[0] = std::exchange(frame_.sender.port, event.sender.port);
  frames_of_port_ = 0;
  if (!again) return;
  again_ = true;
  hopping_ = false;
  frame_.joints = 0;
  frame_.begin(event.time);
  any_told_ = false;
}

bool FrameSource::is_of(const MocapEvent& event) const noexcept {
  return used_ && frame_.form == event.form && frame_.stream == event.stream &&
         frame_.sender.host == event.sender.host;
}

bool FrameSource::had_port(std::uint16_t port) const noexcept {
  return std::ranges::find(ports_, port) != ports_.end();
}

bool FrameSource::is_sender(const MocapEvent& event) const noexcept {
  return used_ && frame_.form == event.form && frame_.sender == event.sender;
}

bool FrameSource::paused(double now) const noexcept {
  const double usual = rate() > 0 ? 1 / rate() : 0;
  return now - seen_ > std::max(0.1, 3 * usual);
}

bool FrameSource::says_ends(double now) const noexcept {
  return facts_of(frame_.form).edges || now - edge_seen_ < lately;
}

// Where a sender says when its frames end, a bone that comes again replaces what came before: some
// tell each hand twice. Else what came first in the frame begins the next one.
bool FrameSource::ends_before(const MocapEvent& event) const noexcept {
  if (!any_told_ || !frame_.contains(event)) return false;
  if (event.kind == MocapKind::values) return true;
  if (says_ends(event.time)) return false;
  return event.kind == first_told_.kind && event.bone == first_told_.bone &&
         event.name == first_told_.name;
}

bool FrameSource::take(const MocapEvent& event) noexcept {
  if (event.time - seen_ > lately) frame_.joints = 0;  // may have another rig by now
  seen_ = event.time;
  if (!any_told_) {
    any_told_ = true;
    first_told_ = event;
  }
  if (frame_.empty() && !frame_.root_told) frame_.time = event.time;
  if (event.time - bones_since_ > lately) {
    bones_before_ = event.time - bones_since_ > 2 * lately ? std::bitset<humanoid_bones>() : bones_;
    bones_.reset();
    bones_since_ = event.time;
  }
  if (event.kind == MocapKind::bone) bones_.set(static_cast<std::size_t>(event.bone));
  return frame_.take(event);
}

// Where an edge is followed by another one that tells the sender's clock, the latter counts.
bool FrameSource::take_edge(const MocapEvent& event) noexcept {
  const bool timed = event.sent == event.sent;
  if (event.kind == MocapKind::clock) {
    frame_.sent = event.sent;
    return false;
  }
  edge_seen_ = event.time;
  if (timed) frame_.sent = event.sent;
  const bool waits = !timed && clocked_;
  clocked_ = timed;
  return !waits;
}

void FrameSource::count_frame() noexcept {
  frame_.begun = again_;
  again_ = false;
  values_ = frame_.values;
  times_[static_cast<std::size_t>(frames_ % most_times)] = frame_.time;
  frames_ = frames_ == 1 << 30 ? most_times : frames_ + 1;
  if (++frames_of_port_ >= 2) hopping_ = false;
}

void FrameSource::begin_next() noexcept {
  any_told_ = false;
  if (frame_.empty())
    frame_.root_told = false;
  else
    frame_.begin(frame_.time);
}

double FrameSource::rate() const noexcept {
  int count = 0;
  double least = seen_;
  for (int i = 0; i < std::min(frames_, most_times); ++i)
    if (seen_ - times_[i] < 1.5 * lately) {
      ++count;
      least = std::min(least, times_[i]);
    }
  const double latest = frames_ > 0 ? times_[(frames_ - 1) % most_times] : least;
  return count > 1 && latest > least ? (count - 1) / (latest - least) : 0;
}

double FrameSource::uneven() const noexcept {
  const int count = std::min(frames_, most_times);
  if (count < 8) return 1;
  std::array<double, most_times> intervals = times_;
  std::sort(intervals.begin(), intervals.begin() + count);
  for (int i = 0; i + 1 < count; ++i) intervals[i] = intervals[i + 1] - intervals[i];
  std::sort(intervals.begin(), intervals.begin() + count - 1);
  const double usual = intervals[(count - 1) / 2];
  return usual > 0 ? intervals[(count - 1) * 95 / 100] / usual : 1;
}

Carried FrameSource::carries() const noexcept {
  if (values_ > 0 || frame_.joints > 0) return Carried::body;
  const auto all = bones();
  const auto any = [&all](std::initializer_list<Bone> wanted) {
    return std::ranges::any_of(wanted, [&](Bone bone) { return all[index_of(bone)]; });
  };
  if (all.none()) return Carried::nothing;
  if (any({Bone::left_upper_leg, Bone::right_upper_leg})) return Carried::body;
  if (any({Bone::left_upper_arm, Bone::right_upper_arm, Bone::left_lower_arm,
           Bone::right_lower_arm}))
    return Carried::upper_body;
  return Carried::face;
}

}  // namespace gait::osc
