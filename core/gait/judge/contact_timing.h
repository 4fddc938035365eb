// When contacts are heard, against when feet touched: what a musician hears of a model.
//
// A captured walk is played to the recogniser as a sender would send it, at the sender's rate and
// with arrivals late by a network's jitter, while a phase clock runs block after block of audio as
// in [gait.viterbi~]. Times in seconds.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "gait/motion/clip.h"
#include "gait/motion/steps.h"
#include "gait/play/play_model.h"
#include "gait/play/recognise/recogniser.h"

namespace gait {

// The ways in which a patch hears a contact: `step` changes with a frame's decision; the phase
// clock sends `contact` after a block of audio and an impulse at a sample.
enum class Heard { step, contact, impulse };
inline constexpr std::array ways_heard{Heard::step, Heard::contact, Heard::impulse};
constexpr std::string_view heard_name(Heard heard) {
  constexpr std::string_view names[] = {"step", "contact", "impulse"};
  return names[static_cast<int>(heard)];
}

struct ContactErrors {
  std::vector<double> late;  // seconds by which each contact was heard late; negative: early
  int touched = 0;           // contacts of the feet
  int missed = 0;            // of those, not heard within half a step
  int extra = 0;             // heard twice, or where no foot touched

  double mean() const;       // NaN without any
  double deviation() const;  // NaN without any
  double quantile(double share) const;
  void add(const ContactErrors& other);
};
using ContactTiming = std::array<ContactErrors, ways_heard.size()>;  // by Heard

struct SenderManner {
  double frame_rate = 0;  // frames per second; 0: the clip's own
  double jitter = 0;      // a frame arrives up to so many seconds late, evenly spread
  double ahead = 0;       // seconds by which contacts are to be heard early
};

// Plays `clip` (metres, Y up; its joints of the model's body in `matched`) and compares with its
// `contacts`, which may lie between frames. The first second, in which the clock finds the walk,
// and the contacts at either end are left out. Errors are those of being `ahead` as asked.
ContactTiming contact_timing(const PlayModel& played, const RecogniserSettings& settings,
                             const Clip& clip, const std::vector<int>& matched,
                             const std::vector<Contact>& contacts, double cycle_seconds,
                             const SenderManner& manner = {});

}  // namespace gait
