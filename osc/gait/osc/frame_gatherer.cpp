#include "gait/osc/frame_gatherer.h"

#include <algorithm>

namespace gait::osc {

namespace {

// Frames under new ports that are further apart than this are of one sender, not of several.
constexpr double hop = 0.004;  // seconds
constexpr double restart_elsewhere = 0.5;

}  // namespace

FrameGatherer::FrameGatherer(int performers)
    : sources_(static_cast<std::size_t>(performers + spare_sources)),
      source_of_(static_cast<std::size_t>(performers), -1),
      from_(source_of_.size()) {}

const CapturedFrame& FrameGatherer::last(int performer) const noexcept {
  return sources_[static_cast<std::size_t>(std::max(0, source_of_[performer]))].frame();
}

int FrameGatherer::performer_of(int source) const noexcept {
  const auto at = std::ranges::find(source_of_, source);
  return at == source_of_.end() ? -1 : static_cast<int>(at - source_of_.begin());
}

bool FrameGatherer::allowed(int performer, const UdpAddress& sender) const noexcept {
  const auto& from = from_[performer];
  return from.empty() || std::ranges::any_of(from, [&](const UdpAddress& chosen) {
           return chosen.host == sender.host && (chosen.port == 0 || chosen.port == sender.port);
         });
}

void FrameGatherer::choose(int performer, std::vector<UdpAddress> from) {
  from_[performer] = std::move(from);
  const int source = source_of_[performer];
  if (source >= 0 && !allowed(performer, sources_[source].frame().sender))
    source_of_[performer] = -1;
}

// The event's own source, or one that goes on under the event's port; -1: it is of a new one.
int FrameGatherer::known_source(const MocapEvent& event) noexcept {
  for (std::size_t i = 0; i < sources_.size(); ++i)
    if (sources_[i].is_of(event) && sources_[i].frame().sender.port == event.sender.port)
      return static_cast<int>(i);
  if (event.kind == MocapKind::edge || event.kind == MocapKind::clock) return -1;
  int paused = -1;  // the last one that has: a program that was started again
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (!sources_[i].is_of(event)) continue;
    if (sources_[i].hopping()) {
      if (!sources_[i].had_port(event.sender.port)) {
        sources_[i].change_port(event, false);
        return static_cast<int>(i);
      }
      sources_[i].set_hopping(false);  // it is several senders
      return -1;
    }
    if (sources_[i].paused(event.time) &&
        (paused < 0 || sources_[i].seen() > sources_[paused].seen()))
      paused = static_cast<int>(i);
  }
  if (paused >= 0) {
    sources_[paused].change_port(event, true);
    return paused;
  }
  return hopping_source(event);
}

// Some senders take a new port for every frame: two sources of one frame each, and now a third.
int FrameGatherer::hopping_source(const MocapEvent& event) noexcept {
  int latest = -1, before = -1;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const FrameSource& source = sources_[i];
    if (!source.is_of(event) || source.frames() > 1) continue;
    if (latest < 0 || source.seen() > sources_[latest].seen()) {
      before = latest;
      latest = static_cast<int>(i);
    } else if (before < 0 || source.seen() > sources_[before].seen()) {
      before = static_cast<int>(i);
    }
  }
  if (before < 0 || sources_[latest].first() - sources_[before].seen() < hop ||
      event.time - sources_[latest].seen() < hop)
    return -1;
  const int kept = performer_of(latest) >= 0 ? latest : before;
  sources_[kept == latest ? before : latest].release();
  sources_[kept].change_port(event, false);
  sources_[kept].set_hopping(true);
  return kept;
}

// One that is not used, else the one that is no performer's and has been silent for longest.
int FrameGatherer::free_source(double now) const noexcept {
  int free = -1;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (!sources_[i].used()) return static_cast<int>(i);
    if (performer_of(static_cast<int>(i)) >= 0 || now - sources_[i].seen() < silence) continue;
    if (free < 0 || sources_[i].seen() < sources_[free].seen()) free = static_cast<int>(i);
  }
  return free;
}

int FrameGatherer::source_of(const MocapEvent& event) noexcept {
  const int known = known_source(event);
  if (known >= 0 || event.kind == MocapKind::edge || event.kind == MocapKind::clock) return known;
  const int free = free_source(event.time);
  if (free >= 0) sources_[free].begin(event);
  return free;
}

void FrameGatherer::take(const MocapEvent& event, FrameSink& sink) noexcept {
  if (event.kind == MocapKind::plain || event.kind == MocapKind::notice) return;  // of no body
  if (event.kind == MocapKind::edge || event.kind == MocapKind::clock) {
    for (std::size_t i = 0; i < sources_.size(); ++i)
      if (sources_[i].is_sender(event) && sources_[i].take_edge(event))
        end(static_cast<int>(i), sink);
    return;
  }
  const int at = source_of(event);
  if (at < 0) {
    ++refused_;
    return;
  }
  if (sources_[at].ends_before(event)) end(at, sink);
  if (!sources_[at].take(event)) ++refused_;
}

void FrameGatherer::end(int source, FrameSink& sink) noexcept {
  FrameSource& from = sources_[source];
  CapturedFrame& frame = from.frame();
  if (!frame.empty()) {
    from.count_frame();
    const int performer = performer_for(source);
    if (performer >= 0)
      sink.frame(performer, frame);
    else
      ++left_out_;
  }
  from.begin_next();
}

void FrameGatherer::end_old(double now, FrameSink& sink) noexcept {
  for (std::size_t i = 0; i < sources_.size(); ++i)
    if (sources_[i].used() && now - sources_[i].frame().time > sources_[i].patience(now) &&
        !sources_[i].frame().empty())
      end(static_cast<int>(i), sink);
}

bool FrameGatherer::replaces(const FrameSource& source, const FrameSource& before) const noexcept {
  const double now = source.seen();
  if (source.carries() > before.carries()) return true;
  if (now - before.seen() > silence) return true;
  // Began after the other one stopped: a restart in another form, or elsewhere.
  if (source.first() < before.seen() || source.carries() < before.carries()) return false;
  return source.frame().sender.host == before.frame().sender.host
             ? before.paused(now)
             : now - before.seen() > restart_elsewhere;
}

int FrameGatherer::performer_for(int source) noexcept {
  const FrameSource& from = sources_[source];
  int found = -1;  // a performer without a source, else the one whose source is silent for longest
  for (int i = 0; i < performers(); ++i) {
    if (source_of_[i] == source) return i;
    if (!allowed(i, from.frame().sender)) continue;
    if (source_of_[i] >= 0 && !replaces(from, sources_[source_of_[i]])) continue;
    const auto since = [this](int at) {
      return source_of_[at] < 0 ? -1e300 : sources_[source_of_[at]].seen();
    };
    if (found < 0 || since(i) < since(found)) found = i;
  }
  if (found >= 0) source_of_[found] = source;
  return found;
}

}  // namespace gait::osc
