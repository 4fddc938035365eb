#include "gait/learn/walk_sequences.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "gait/error.h"
#include "gait/model/body_pose.h"
#include "gait/motion/contacts.h"
#include "gait/motion/resample.h"
#include "gait/motion/rotation.h"
#include "gait/names.h"

namespace gait {

namespace {

constexpr double default_frame_rate = 30;
// A joint is a hinge when its bones lie so far from in line in the mean (sine of the angle), and
// its axes agree as much.
constexpr double least_bend = 0.05, least_agreement = 0.9;

std::vector<int> named_joints(const Skeleton& skeleton, const std::vector<std::string>& names,
                              const char* which) {
  std::vector<int> joints;
  std::string unknown;
  for (const std::string& name : names) {
    const int joint = skeleton.find(name);
    if (joint < 0)
      append_name(unknown, name);
    else if (std::find(joints.begin(), joints.end(), joint) == joints.end())
      joints.push_back(joint);
  }
  if (!unknown.empty())
    throw Error(std::string(which) + " joints: unknown: " + unknown + "; the clips have " +
                joined_names(skeleton.joints, &Joint::name));
  std::sort(joints.begin(), joints.end());
  return joints;
}

Body body_of(const Clip& clip, const WalkOptions& options) {
  Body body;
  body.skeleton = clip.skeleton;
  const JointRoles roles = find_roles(clip, options.roles);
  if (!roles.has_legs())
    throw Error(clip.name +
                ": expected joints for hips and for thigh, shank and foot of both legs; name them "
                "with a role table");
  body.roles = roles.of_joint;
  body.roles[roles.hips] = Role::hips;
  body.output_joints = options.output_joints.empty()
                           ? roles.hips_and_legs()
                           : named_joints(clip.skeleton, options.output_joints, "output");
  const auto contains = [](const std::vector<int>& joints, int joint) {
    return std::find(joints.begin(), joints.end(), joint) != joints.end();
  };
  const std::vector<int> lower = roles.hips_and_legs();
  if (options.input_joints.empty()) {
    for (int joint = 0; joint < clip.skeleton.size(); ++joint)
      if (!contains(body.output_joints, joint) && !contains(lower, joint) &&
          (joint == roles.hips || !clip.skeleton.is_in_branch(roles.hips, joint)))
        body.input_joints.push_back(joint);
  } else {
    body.input_joints = named_joints(clip.skeleton, options.input_joints, "input");
    for (const int joint : body.input_joints)
      if (contains(body.output_joints, joint))
        throw Error("joint " + clip.skeleton.joints[joint].name +
                    ": expected to be input or output; it is named as both");
  }
  if (body.input_joints.empty()) throw Error("expected at least one input joint; there is none");
  return body;
}

// A clip on the body: its poses, and its steps at the model's rate.
struct Seen {
  std::vector<int> matched;
  double cycle_seconds = 0;
  BodyPoses poses;
  std::vector<Contact> contacts;
};

// Contacts may come from a file or a program.
void check_contacts(const Walk& walk) {
  int before = -1;
  for (const Contact& contact : walk.contacts) {
    if (contact.frame <= before || contact.frame >= walk.clip.frames())
      throw Error(walk.clip.name + ": expected contacts one after the other within the clip's " +
                  std::to_string(walk.clip.frames()) + " frames; found one at frame " +
                  std::to_string(contact.frame) + " (counted from 0)");
    before = contact.frame;
  }
}

// The longest run of steps that follow each other without a gap.
std::vector<Segment> segments_of(const std::vector<Contact>& contacts) {
  std::vector<Segment> run, longest;
  for (const Step& step : steps_between(contacts)) {
    if (!run.empty() && run.back().end != step.begin) run.clear();
    run.push_back({step.begin, step.end, step.foot == Foot::right ? 0 : 1, step.offset});
    if (run.size() > longest.size()) longest = run;
  }
  return longest;
}

// Steps of a short clip that can be learnt from: with their past, and a frame behind them.
int learnable_steps(const std::vector<Contact>& contacts, int frames, double history_frames) {
  int count = 0;
  for (const Segment& step : segments_of(contacts))
    count += step.begin >= history_frames && step.end < frames;
  return count;
}

// The reference rotation of each joint: the chordal mean over all frames of all used clips.
std::vector<Eigen::Quaterniond> references_of(const std::vector<Seen>& seen, int joints) {
  std::vector<Eigen::Quaterniond> references, of_joint;
  for (int joint = 0; joint < joints; ++joint) {
    of_joint.clear();
    for (const Seen& one : seen)
      for (int frame = 0; frame < one.poses.frames(); ++frame)
        of_joint.push_back(one.poses.pose(frame)[joint]);
    references.push_back(chordal_mean(of_joint));
  }
  return references;
}

// Axes and ranges of knees and elbows over all frames of all used clips, without one frame in a
// thousand at either end of the range: these may be errors of the capture.
std::vector<Hinge> hinges_of(const std::vector<Seen>& seen, const Body& body) {
  std::vector<Hinge> hinges;
  for (Hinge hinge : find_hinges(body.skeleton, body_roles(body))) {
    std::vector<HingeBones<double>> bones;
    Eigen::Vector3d normals = Eigen::Vector3d::Zero();
    double bent = 0;
    for (const Seen& one : seen)
      for (int frame = 0; frame < one.poses.frames(); ++frame) {
        bones.push_back(hinge_bones<double>(body.skeleton, hinge, one.poses.pose(frame)));
        const Eigen::Vector3d normal =
            bones.back().above.normalized().cross(bones.back().below.normalized());
        normals += normal, bent += normal.norm();
      }
    const bool bends = bent > least_bend * static_cast<double>(bones.size());
    if (!bends || !(normals.norm() > least_agreement * bent)) continue;
    hinge.axis = normals.normalized();
    std::vector<double> angles;
    for (const HingeBones<double>& bone : bones) angles.push_back(bone.angle(hinge.axis));
    std::sort(angles.begin(), angles.end());
    const std::size_t outliers = angles.size() / 1000;
    hinge.least = angles[outliers], hinge.most = angles[angles.size() - 1 - outliers];
    hinges.push_back(hinge);
  }
  return hinges;
}

Eigen::MatrixXd values_of(const BodyPoses& poses, const Body& body,
                          const std::vector<int>& joints) {
  Eigen::MatrixXd values(3 * joints.size(), poses.frames());
  for (int frame = 0; frame < poses.frames(); ++frame)
    pose_vector<double>(poses.pose(frame), body.references, joints,
                        {values.col(frame).data(), static_cast<std::size_t>(values.rows())});
  return values;
}

std::vector<Stream> streams_of(const Body& body, const std::vector<int>& joints) {
  std::vector<Stream> streams;
  for (const int joint : joints)
    streams.push_back({body.skeleton.joints[joint].name, 3, StreamKind::rotation});
  return streams;
}

// `together`: steps in all clips of its style and subject.
std::string why_not_used(const WalkUse& use, int together, const WalkOptions& options) {
  if (use.steps > 0 && together >= options.fewest_steps) {
    char text[96];
    std::snprintf(text, sizeof text, "expected a step with %.2g s of motion before it, found none",
                  options.history);
    return text;
  }
  return "expected at least " + std::to_string(options.fewest_steps) + " steps" +
         (together > use.steps
              ? " in the clips of its style and subject, found " + std::to_string(together)
              : ", found " + std::to_string(use.steps));
}

}  // namespace

Sequence walk_sequence(const Body& body, const BodyPoses& poses,
                       const std::vector<Contact>& contacts, const std::string& name) {
  Sequence sequence;
  sequence.name = name;
  sequence.inputs = values_of(poses, body, body.input_joints);
  sequence.outputs = values_of(poses, body, body.output_joints);
  sequence.segments = segments_of(contacts);
  return sequence;
}

std::vector<Contact> contacts_at(const std::vector<Contact>& contacts, double ratio) {
  std::vector<Contact> scaled = contacts;
  for (Contact& contact : scaled) {
    const double touch = (contact.frame + contact.offset) * ratio;
    contact.frame = static_cast<int>(std::lround(contact.frame * ratio));
    contact.offset = touch - contact.frame;
  }
  return scaled;
}

WalkSequences walk_sequences(const std::vector<Walk>& walks, const WalkOptions& options) {
  if (walks.empty()) throw Error("expected at least one walk; found none");
  WalkSequences result;
  double slowest = walks.front().clip.frame_rate;
  for (const Walk& walk : walks) slowest = std::min(slowest, walk.clip.frame_rate);
  result.frame_rate =
      options.frame_rate > 0 ? options.frame_rate : std::min(default_frame_rate, slowest);
  // A frame time written with few digits still means thirty frames a second.
  if (std::abs(result.frame_rate - std::round(result.frame_rate)) < 0.01)
    result.frame_rate = std::round(result.frame_rate);
  result.body = body_of(walks.front().clip, options);

  std::vector<Seen> seen;
  std::vector<double> cycle_seconds;
  std::map<std::pair<std::string, std::string>, int> together;  // steps per style and subject
  std::set<std::pair<std::string, std::string>> in_whole_clips;
  std::vector<int> learnable;
  for (const Walk& walk : walks) {
    WalkUse use;
    use.name = walk.clip.name;
    use.style = walk.style;
    check_contacts(walk);
    Seen one;
    one.matched = match_joints(result.body, walk.clip.skeleton, walk.clip.name);
    JointRoles roles = find_roles(walk.clip, options.roles);
    const WalkTrack track = follow_walk(walk.clip, roles);
    const double ratio = result.frame_rate / walk.clip.frame_rate;
    one.contacts = contacts_at(walk.contacts.empty() ? track.contacts : walk.contacts, ratio);
    one.cycle_seconds = track.cycle_seconds;
    use.steps = static_cast<int>(segments_of(one.contacts).size());
    use.seconds = walk.clip.frames() / walk.clip.frame_rate;
    use.speed = walk.speed.value_or(track.speed);
    use.treadmill = track.treadmill;
    if (std::abs(ratio - 1) > 1e-3) {
      char text[64];
      std::snprintf(text, sizeof text, "resampled from %g to %g frames/s", walk.clip.frame_rate,
                    result.frame_rate);
      use.remark = text;
    }
    learnable.push_back(use.steps >= options.fewest_steps
                            ? use.steps
                            : learnable_steps(one.contacts,
                                              static_cast<int>(walk.clip.frames() * ratio),
                                              options.history * result.frame_rate));
    together[{walk.style, walk.subject}] += learnable.back();
    if (use.steps >= options.fewest_steps) in_whole_clips.emplace(walk.style, walk.subject);
    result.uses.push_back(std::move(use));
    seen.push_back(std::move(one));
  }
  std::vector<Seen> all = std::move(seen);
  seen.clear();
  for (std::size_t i = 0; i < walks.size(); ++i) {
    WalkUse& use = result.uses[i];
    const bool whole = use.steps >= options.fewest_steps;
    const std::pair way{walks[i].style, walks[i].subject};
    // Beside longer clips, short ones made strangers' legs worse (CMU: 10.5 to 11.0 degrees).
    const int steps = in_whole_clips.contains(way) ? use.steps : together[way];
    if (!whole && (learnable[i] == 0 || steps < options.fewest_steps)) {
      use.why_not = why_not_used(use, steps, options);
      continue;
    }
    use.used = true;
    cycle_seconds.push_back(all[i].cycle_seconds);
    seen.push_back(std::move(all[i]));
    result.walk_of_sequence.push_back(static_cast<int>(i));
  }
  if (seen.empty())
    throw Error("expected clips of one style and subject with " +
                std::to_string(options.fewest_steps) + " steps together; none of " +
                std::to_string(walks.size()) + " clips is of such: " + walks.front().clip.name +
                ": " + result.uses.front().why_not);
  std::nth_element(cycle_seconds.begin(), cycle_seconds.begin() + cycle_seconds.size() / 2,
                   cycle_seconds.end());
  result.body.heading_window = cycle_seconds[cycle_seconds.size() / 2];
  // Only now: measured hips are seen through the window that playing will have.
  for (std::size_t i = 0; i < seen.size(); ++i)
    seen[i].poses = body_poses(resampled(walks[result.walk_of_sequence[i]].clip, result.frame_rate),
                               result.body, seen[i].matched, seen[i].cycle_seconds);
  result.body.references = references_of(seen, result.body.skeleton.size());
  result.body.hinges = hinges_of(seen, result.body);
  result.inputs = streams_of(result.body, result.body.input_joints);
  result.outputs = streams_of(result.body, result.body.output_joints);

  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Walk& walk = walks[result.walk_of_sequence[i]];
    Sequence sequence = walk_sequence(result.body, seen[i].poses, seen[i].contacts, walk.clip.name);
    sequence.subject = walk.subject;
    if (!walk.style.empty()) {
      auto at = std::find(result.styles.begin(), result.styles.end(), walk.style);
      if (at == result.styles.end()) at = result.styles.insert(at, walk.style);
      sequence.style = static_cast<int>(at - result.styles.begin());
    }
    result.sequences.push_back(std::move(sequence));
  }
  return result;
}

}  // namespace gait
