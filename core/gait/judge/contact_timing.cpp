#include "gait/judge/contact_timing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "gait/learn/walk_sequences.h"
#include "gait/model/body_pose.h"
#include "gait/motion/resample.h"
#include "gait/play/input/sender_clock.h"
#include "gait/play/recognise/live_recogniser.h"

namespace gait {

namespace {

constexpr double audio_rate = 48000;
constexpr int audio_block = 64;
constexpr double finding_the_walk = 1;  // seconds, which do not count
constexpr double not_heard = std::numeric_limits<double>::quiet_NaN();

struct Event {
  double time = 0;  // seconds
  int step = 0;     // 0 right, 1 left
};

using Events = std::array<std::vector<Event>, ways_heard.size()>;

std::vector<Event>& of(Events& events, Heard heard) {
  return events[static_cast<std::size_t>(heard)];
}

// What [gait.viterbi~] sends while the frames arrive.
class Listening {
 public:
  Listening(const PlayModel& played, const RecogniserSettings& settings, double ahead)
      : live_(played, settings), clock_(live_.recogniser().clock_settings()) {
    clock_.set_ahead(ahead);
  }

  void arrive(double now, std::span<const float> values) {
    live_.stream().push(sender_.time_of_arrival(now), values);
    while (live_.next()) {
      clock_.set_walking(live_.walking());
      const PhaseEstimate& estimate = live_.recogniser().phase_estimate();
      clock_.observe(estimate.seen, estimate.certainty, live_.estimate_late());
      if (live_.walking() && live_.decision().label != label_) {
        label_ = live_.decision().label;
        of(events_, Heard::step).push_back({now, label_});
      }
    }
  }
  void play_block(double now) {
    clock_.process(audio_block, audio_rate);
    for (const PhaseClock::Crossing& crossing : clock_.crossings()) {
      of(events_, Heard::impulse).push_back({now + crossing.sample / audio_rate, crossing.step});
      of(events_, Heard::contact).push_back({now + audio_block / audio_rate, crossing.step});
    }
  }
  const Events& events() const { return events_; }

 private:
  LiveRecogniser live_;
  PhaseClock clock_;
  SenderClock sender_;
  Events events_;
  int label_ = -1;
};

// Each event belongs to the nearest contact of its foot, within half of the steps around it.
ContactErrors compare(const std::vector<Event>& events, const std::vector<Event>& touched,
                      double ahead) {
  ContactErrors errors;
  if (touched.size() < 3) return errors;
  std::vector<double> late(touched.size(), not_heard);
  for (const Event& event : events) {
    const double time = event.time + ahead;
    const auto after = std::find_if(touched.begin(), touched.end(),
                                    [&](const Event& touch) { return touch.time > time; });
    if (after == touched.begin() || after == touched.end()) continue;
    const auto nearest = time - (after - 1)->time < after->time - time ? after - 1 : after;
    const auto i = static_cast<std::size_t>(nearest - touched.begin());
    if (i == 0 || i + 1 == touched.size() || nearest->time < finding_the_walk) continue;
    if (event.step != nearest->step || !std::isnan(late[i]))
      ++errors.extra;
    else
      late[i] = time - nearest->time;
  }
  for (std::size_t i = 1; i + 1 < touched.size(); ++i) {
    if (touched[i].time < finding_the_walk) continue;
    ++errors.touched;
    if (std::isnan(late[i]))
      ++errors.missed;
    else
      errors.late.push_back(late[i]);
  }
  return errors;
}

}  // namespace

double ContactErrors::mean() const {
  return late.empty()
             ? not_heard
             : std::accumulate(late.begin(), late.end(), 0.0) / static_cast<double>(late.size());
}

double ContactErrors::deviation() const {
  const double about = mean();
  double sum = 0;
  for (const double error : late) sum += (error - about) * (error - about);
  return late.empty() ? not_heard : std::sqrt(sum / static_cast<double>(late.size()));
}

double ContactErrors::quantile(double share) const {
  if (late.empty()) return not_heard;
  std::vector<double> sorted = late;
  const auto at = sorted.begin() + std::lround(share * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

void ContactErrors::add(const ContactErrors& other) {
  late.insert(late.end(), other.late.begin(), other.late.end());
  touched += other.touched;
  missed += other.missed;
  extra += other.extra;
}

ContactTiming contact_timing(const PlayModel& played, const RecogniserSettings& settings,
                             const Clip& clip, const std::vector<int>& matched,
                             const std::vector<Contact>& contacts, double cycle_seconds,
                             const SenderManner& manner) {
  const Body& body = *played.model->body;
  const double rate = manner.frame_rate > 0 ? manner.frame_rate : clip.frame_rate;
  const BodyPoses poses = body_poses(resampled(clip, rate), body, matched, cycle_seconds);
  const Eigen::MatrixXf inputs = walk_sequence(body, poses, {}, clip.name).inputs.cast<float>();

  Listening listening(played, settings, manner.ahead);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(0, manner.jitter);
  Eigen::Index frame = 0;
  double arrival = jitter(random);
  for (int block = 0; frame < inputs.cols(); ++block) {
    const double now = block * audio_block / audio_rate;
    while (frame < inputs.cols() && arrival <= now) {
      listening.arrive(arrival,
                       {inputs.col(frame).data(), static_cast<std::size_t>(inputs.rows())});
      ++frame;
      // A network does not let one frame overtake another.
      arrival = std::max(arrival, static_cast<double>(frame) / rate + jitter(random));
    }
    listening.play_block(now);
  }
  std::vector<Event> touched;
  for (const Contact& contact : contacts)
    touched.push_back({contact.seconds(clip.frame_rate), contact.foot == Foot::left});
  ContactTiming timing;
  for (const Heard heard : ways_heard) {
    const auto way = static_cast<std::size_t>(heard);
    timing[way] = compare(listening.events()[way], touched, manner.ahead);
  }
  return timing;
}

}  // namespace gait
