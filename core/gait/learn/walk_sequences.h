// Walk sequences: captured walks as sequences for learning, with the body they share, its streams,
// and steps as segments.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gait/learn/sequence.h"
#include "gait/model/body_pose.h"
#include "gait/model/model.h"
#include "gait/motion/clip.h"
#include "gait/motion/steps.h"

namespace gait {

struct Walk {
  Clip clip;                      // metres, Y up
  std::string style, subject;     // empty: unknown
  std::optional<double> speed;    // m/s, if known
  std::vector<Contact> contacts;  // empty: found in the clip
};

struct WalkOptions {
  double frame_rate = 0;                   // of the model; 0: 30, or the clips' own when slower
  std::vector<std::string> input_joints;   // names; empty: all but hips and legs
  std::vector<std::string> output_joints;  // names; empty: hips and legs
  RoleTable roles;                         // overrides what names suggest
  // A clip with fewer is used when the clips of its style and subject have so many together.
  int fewest_steps = 4;
  // Seconds of motion that a step needs before it, to be learnt from (LearningOptions::history).
  double history = 10.0 / 30;
};

// Whether and how learning used one walk.
struct WalkUse {
  std::string name, style;
  bool used = false;
  std::string why_not;  // when not used
  std::string remark;   // e.g. that it was resampled
  int steps = 0;
  double seconds = 0, speed = 0;
  bool treadmill = false;
};

struct WalkSequences {
  double frame_rate = 30;
  Body body;
  std::vector<Stream> inputs, outputs;
  std::vector<std::string> styles;    // sorted by first appearance
  std::vector<Sequence> sequences;    // labels: 0 right, 1 left
  std::vector<int> walk_of_sequence;  // index into the walks
  std::vector<WalkUse> uses;          // one per walk
};

// One walk on a body: pose vectors of the body's input and output joints, and the longest unbroken
// run of steps as segments (labels: 0 right, 1 left). `contacts` in frames of `poses`.
Sequence walk_sequence(const Body& body, const BodyPoses& poses,
                       const std::vector<Contact>& contacts, const std::string& name);

// Contacts at another frame rate, `ratio` times the one they were found at.
std::vector<Contact> contacts_at(const std::vector<Contact>& contacts, double ratio);

// Throws Error when no walk is usable, when the options name joints that the clips lack, or when
// the walks' bodies do not match.
WalkSequences walk_sequences(const std::vector<Walk>& walks, const WalkOptions& options);

}  // namespace gait
