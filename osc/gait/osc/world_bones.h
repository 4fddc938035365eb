// World bones: what readers share whose forms tell, or let them reckon, each bone's turn in the
// world since the T-pose. Also what they remember of each sender.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "gait/osc/form_reader.h"

namespace gait::osc {

// A bone's turn, and its place in the world where that is known. Right-handed, Y up, metres.
inline void tell_bone(MocapForm form, const Arrival& arrival, std::uint32_t stream, int bone,
                      const Eigen::Quaterniond& turn, const Eigen::Vector3d* place,
                      EventSink& sink) {
  MocapEvent event = event_of(MocapKind::bone, form, arrival);
  event.stream = stream;
  event.bone = static_cast<std::int16_t>(bone);
  const Eigen::Quaternionf q = turn.normalized().cast<float>();
  event.rotation = {q.x(), q.y(), q.z(), q.w()};
  event.rotated = true;
  if (place) {
    event.placed = true;
    for (int i = 0; i < 3; ++i)
      event.place[static_cast<std::size_t>(i)] = static_cast<float>((*place)[i]);
  }
  sink.take(event);
}

inline void tell_end(MocapForm form, const Arrival& arrival, double sent, EventSink& sink) {
  MocapEvent edge = event_of(MocapKind::edge, form, arrival);
  edge.sent = sent;
  sink.take(edge);
}

// A value for each of the latest senders; `key` distinguishes several of one sender.
template <class T, std::size_t most = 16>
class PerSender {
 public:
  T& of(const UdpAddress& sender, std::uint32_t key = 0) {
    for (Entry& entry : entries_)
      if (entry.used && entry.sender == sender && entry.key == key) return entry.value;
    Entry& entry = entries_[next_];
    next_ = (next_ + 1) % most;
    entry.used = true;
    entry.sender = sender;
    entry.key = key;
    entry.value = {};
    return entry.value;
  }

 private:
  struct Entry {
    bool used = false;
    UdpAddress sender;
    std::uint32_t key = 0;
    T value;
  };
  std::array<Entry, most> entries_;
  std::size_t next_ = 0;
};

}  // namespace gait::osc
