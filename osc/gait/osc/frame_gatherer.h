// Frame gatherer: gathers the events of each sender into frames, and gives each performer a sender.
//
// A frame ends with the sender's message that ends it; without such messages, when what came first
// comes again; and at the latest some time after its first event (FrameSource::patience). Sources
// of frames are distinguished by the sender's address and, within a sender, by skeleton or user. A
// performer keeps its source until that has been silent for a second and another needs the slot,
// until the sender restarts under another port or in another form, or until one comes that carries
// more: a body instead of a face. Nothing but choose() allocates after construction.
#pragma once

#include <vector>

#include "gait/osc/frame_source.h"

namespace gait::osc {

class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual void frame(int performer, const CapturedFrame& frame) noexcept = 0;
};

class FrameGatherer {
 public:
  static constexpr double silence = 1.0;    // seconds after which a slot may be reused
  static constexpr int spare_sources = 16;  // beyond the number of performers

  explicit FrameGatherer(int performers);

  void take(const MocapEvent& event, FrameSink& sink) noexcept;
  // Ends frames that have been open for too long. `now`: on the clock of arrivals.
  void end_old(double now, FrameSink& sink) noexcept;

  int performers() const noexcept { return static_cast<int>(source_of_.size()); }
  const CapturedFrame& last(int performer) const noexcept;
  // Lets a performer come from these hosts alone, and from their ports where they are not 0;
  // without any, from everywhere. Allocates.
  void choose(int performer, std::vector<UdpAddress> from);

  const std::vector<FrameSource>& sources() const noexcept { return sources_; }
  // The performer of a source, -1: none. `source`: index into sources().
  int performer_of(int source) const noexcept;
  // Number of events refused: of sources beyond those there is room for, and of joints beyond
  // most_joints.
  std::uint64_t refused() const noexcept { return refused_; }
  // Number of frames of sources that are no performer's.
  std::uint64_t left_out() const noexcept { return left_out_; }

 private:
  int source_of(const MocapEvent& event) noexcept;
  int known_source(const MocapEvent& event) noexcept;
  int hopping_source(const MocapEvent& event) noexcept;
  int free_source(double now) const noexcept;
  int performer_for(int source) noexcept;
  bool allowed(int performer, const UdpAddress& sender) const noexcept;
  bool replaces(const FrameSource& source, const FrameSource& before) const noexcept;
  void end(int source, FrameSink& sink) noexcept;

  std::vector<FrameSource> sources_;
  std::vector<int> source_of_;  // per performer, -1: none
  std::vector<std::vector<UdpAddress>> from_;
  std::uint64_t refused_ = 0, left_out_ = 0;
};

}  // namespace gait::osc
