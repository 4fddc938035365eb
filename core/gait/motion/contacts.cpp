#include "gait/motion/contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gait/error.h"
#include "gait/motion/heading.h"

namespace gait {

namespace {

constexpr double first_guess_of_cycle = 1.1;    // seconds; an adult's at an easy pace
constexpr double least_stride_per_leg = 0.12;   // feet closer than this never stepped
constexpr double shortest_step_seconds = 0.18;  // a stumble, not a step

class Walk {
 public:
  Walk(const Clip& clip, const JointRoles& roles, const WorldPoses& world)
      : skeleton_(clip.skeleton),
        roles_(roles),
        world_(world),
        joints_(clip.skeleton.size()),
        frames_(clip.frames()) {}

  int frames() const { return frames_; }
  const Eigen::Vector3d& position(int frame, int joint) const {
    return world_.positions[static_cast<std::size_t>(frame) * joints_ + joint];
  }
  int foot(Foot foot) const { return foot == Foot::right ? roles_.right.foot : roles_.left.foot; }
  // How far a foot is ahead of the hips along the heading, metres.
  double ahead(int frame, Foot which, const std::vector<double>& heading) const {
    return (position(frame, foot(which)) - position(frame, roles_.hips))
        .dot(heading_direction(heading[frame]));
  }

  // Largest backward travel of a foot's points relative to the hips between two frames, metres: the
  // point on the ground travels farthest. The ankle alone would read a twentieth too little,
  // because it moves forward while the foot rolls.
  double stance_travel(int from, int to, Foot which, const std::vector<double>& heading) const {
    double farthest = std::numeric_limits<double>::lowest();
    const auto ahead_of_hips = [&](int frame, int joint, const Eigen::Vector3d& tip) {
      const auto& rotation = world_.rotations[static_cast<std::size_t>(frame) * joints_ + joint];
      return (position(frame, joint) + rotation * tip - position(frame, roles_.hips))
          .dot(heading_direction(heading[from]));
    };
    const auto look_at = [&](int joint, const Eigen::Vector3d& tip) {
      farthest =
          std::max(farthest, ahead_of_hips(from, joint, tip) - ahead_of_hips(to, joint, tip));
    };
    for (int joint = foot(which); joint < joints_; ++joint) {
      int above = joint;
      while (above > foot(which)) above = skeleton_.joints[above].parent;
      if (above != foot(which)) continue;
      look_at(joint, Eigen::Vector3d::Zero());
      for (const Eigen::Vector3d& tip : skeleton_.joints[joint].tips) look_at(joint, tip);
    }
    return farthest;
  }

 private:
  const Skeleton& skeleton_;
  const JointRoles& roles_;
  const WorldPoses& world_;
  int joints_, frames_;
};

// Where between its neighbours a parabola through three values has its maximum, the middle one
// being the largest: -0.5 to 0.5 of their distance.
double between_frames(double before, double largest, double after) {
  const double curvature = before - 2 * largest + after;
  return curvature < 0 ? std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5) : 0;
}

// The foot ahead changes with each step: between two changes lies one contact, where the leading
// foot is farthest ahead of the hips. Hysteresis keeps a shuffle from counting.
std::vector<Contact> contacts_along(const Walk& walk, const std::vector<double>& heading,
                                    double leg_length, double frame_rate) {
  const int frames = walk.frames();
  std::vector<double> right_lead(frames);
  double widest = 0;
  for (int frame = 0; frame < frames; ++frame) {
    right_lead[frame] =
        walk.ahead(frame, Foot::right, heading) - walk.ahead(frame, Foot::left, heading);
    widest = std::max(widest, std::abs(right_lead[frame]));
  }
  if (widest < least_stride_per_leg * leg_length) return {};
  const double threshold = 0.15 * widest;

  // By the furthest moments of all leads, whatever their length.
  std::vector<Contact> leads;
  int begin = 0, lead = 0;  // lead: +1 right foot ahead, -1 left, 0 not known yet
  const auto close = [&](int end) {
    if (lead == 0) return;
    const Foot foot = lead > 0 ? Foot::right : Foot::left;
    int best = begin;
    for (int frame = begin; frame < end; ++frame)
      if (walk.ahead(frame, foot, heading) > walk.ahead(best, foot, heading)) best = frame;
    // A maximum at the clip's edge is where the capture began or stopped, not a contact.
    if (best == 0 || best == frames - 1) return;
    const auto ahead = [&](int frame) { return walk.ahead(frame, foot, heading); };
    leads.push_back({best, foot, between_frames(ahead(best - 1), ahead(best), ahead(best + 1))});
  };
  for (int frame = 0; frame < frames; ++frame) {
    const int now = right_lead[frame] > threshold ? 1 : right_lead[frame] < -threshold ? -1 : 0;
    if (now == 0 || now == lead) continue;
    close(frame);
    begin = lead == 0 ? 0 : frame;
    lead = now;
  }
  close(frames);

  // Where most leads are so short, it is the clock that is fast, not the walker who stumbles.
  std::vector<int> apart;
  for (std::size_t i = 0; i + 1 < leads.size(); ++i)
    apart.push_back(leads[i + 1].frame - leads[i].frame);
  const auto middle = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2);
  double shortest = shortest_step_seconds * frame_rate;
  if (!apart.empty()) {
    std::nth_element(apart.begin(), middle, apart.end());
    if (*middle < shortest) shortest = *middle / 2.0;
  }
  std::vector<Contact> contacts;
  for (const Contact& contact : leads)
    if (contacts.empty() ||
        (contact.frame - contacts.back().frame >= shortest && contact.foot != contacts.back().foot))
      contacts.push_back(contact);
  return contacts;
}

double median_cycle(const std::vector<Contact>& contacts, double frame_rate) {
  std::vector<int> lengths;
  for (std::size_t i = 0; i + 2 < contacts.size(); ++i)
    lengths.push_back(contacts[i + 2].frame - contacts[i].frame);
  if (lengths.empty())
    return contacts.size() < 2 ? first_guess_of_cycle
                               : 2 * (contacts[1].frame - contacts[0].frame) / frame_rate;
  std::nth_element(lengths.begin(), lengths.begin() + lengths.size() / 2, lengths.end());
  return lengths[lengths.size() / 2] / frame_rate;
}

// Median over the steps of the standing foot's mean backward speed against the hips.
double stance_speed(const Walk& walk, const WalkTrack& track, double frame_rate) {
  std::vector<double> speeds;
  for (std::size_t i = 0; i + 1 < track.contacts.size(); ++i) {
    const Contact& contact = track.contacts[i];
    const int length = track.contacts[i + 1].frame - contact.frame;
    // Leaves out the landing of this foot and of the other. Measures over a thirtieth of a second,
    // because from frame to frame the noise of sensors would look like speed.
    const int end = contact.frame + (9 * length) / 10;
    const int stride = std::max(1, static_cast<int>(std::lround(frame_rate / 30)));
    double travel = 0;
    int frames = 0;
    for (int frame = contact.frame + length / 10; frame + stride <= end; frame += stride) {
      travel += walk.stance_travel(frame, frame + stride, contact.foot, track.heading);
      frames += stride;
    }
    if (frames > 0) speeds.push_back(travel * frame_rate / frames);
  }
  if (speeds.empty()) return 0;
  std::nth_element(speeds.begin(), speeds.begin() + speeds.size() / 2, speeds.end());
  return speeds[speeds.size() / 2];
}

}  // namespace

WalkTrack follow_walk(const Clip& clip, const JointRoles& roles) {
  if (!roles.has_legs())
    throw Error(clip.name +
                ": expected joints for hips and for thigh, shank and foot of both legs; found none "
                "for some of them (a role table can name them)");
  WalkTrack track;
  track.world = world_poses(clip);
  const Walk walk(clip, roles, track.world);
  track.leg_length = leg_length(clip.skeleton, roles);
  if (clip.frames() < 3) {
    track.heading.assign(clip.frames(), 0.0);
    return track;
  }
  // Heading needs the cycle and the cycle needs contacts: twice is enough, both change slowly.
  for (int pass = 0; pass < 2; ++pass) {
    track.heading = centred_heading(track.world, roles, clip.skeleton.size(), clip.frame_rate,
                                    track.cycle_seconds);
    track.contacts = contacts_along(walk, track.heading, track.leg_length, clip.frame_rate);
    track.cycle_seconds = median_cycle(track.contacts, clip.frame_rate);
  }
  double path = 0;
  const int first = track.contacts.empty() ? 0 : track.contacts.front().frame;
  const int last = track.contacts.empty() ? clip.frames() - 1 : track.contacts.back().frame;
  for (int frame = first; frame < last; ++frame) {
    Eigen::Vector3d moved = walk.position(frame + 1, roles.hips) - walk.position(frame, roles.hips);
    path += moved.dot(heading_direction(track.heading[frame]));
  }
  track.root_speed = last > first ? path * clip.frame_rate / (last - first) : 0;
  track.feet_speed = stance_speed(walk, track, clip.frame_rate);
  track.treadmill = track.feet_speed > 0.2 && std::abs(track.root_speed) < 0.3 * track.feet_speed;
  track.speed = track.treadmill ? track.feet_speed : std::abs(track.root_speed);
  return track;
}

double natural_frequency(double speed_per_leg, double leg_length) {
  constexpr double inman = 0.743, grown_leg = 0.83;
  return inman * std::sqrt(speed_per_leg * std::sqrt(grown_leg / leg_length));
}

bool is_straight(const WalkTrack& track, const Cycle& cycle, double limit) {
  const auto [low, high] =
      std::minmax_element(track.heading.begin() + cycle.begin, track.heading.begin() + cycle.end);
  return *high - *low < limit;
}

std::vector<Cycle> straight_cycles(const WalkTrack& track, double limit) {
  std::vector<Cycle> straight = cycles_between(track.contacts);
  std::erase_if(straight, [&](const Cycle& cycle) { return !is_straight(track, cycle, limit); });
  return straight;
}

}  // namespace gait
