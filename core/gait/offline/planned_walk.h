// Walks by plan: a plan sets speed, style or direction over time, a walker follows it, and its
// frames become a clip.
//
// Units: metres, seconds, radians; speeds in m/s.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gait/model/model.h"
#include "gait/motion/clip.h"
#include "gait/play/cycles/speed_walker.h"
#include "gait/play/play_model.h"

namespace gait {

struct StyleShare {
  std::string style;
  double weight = 1;
};

// One weight per style of the model, sum 1; what is not named gets none. Throws Error listing the
// styles that walk when one is unknown or cannot walk, and when a weight is negative or not finite
// or all are zero.
std::vector<float> style_weights(const Model& model, std::span<const StyleShare> shares);

struct StyleChange {
  double seconds = 0;  // after the clip's begin
  std::vector<StyleShare> mix;
};

struct StyledWalkPlan {
  std::vector<StyleShare> mix;
  std::vector<StyleChange> changes;  // in time; each comes about within a step
  double variation = 1;              // 0 the mean cycle, to 2
  double exaggeration = 1;           // -1 to 3
  int cycles = 0;                    // 0: as many as `seconds` take
  double seconds = 0;
  std::uint64_t seed = 1;
  double turn = 0;        // heading rate, radians per second, above 0 to the left
  double frame_rate = 0;  // 0: the model's
};

// A walk in styles (T10 §7) that is under way when the clip begins, at a right contact. Throws
// Error when the model has no space of styles.
Clip styled_walk(const std::shared_ptr<const Model>& model, const StyledWalkPlan& plan);

// The same step by step (T14 §4.3): smooth means, no cycle differs from the one before;
// `variation`, `exaggeration` and `seed` mean nothing here. Without a mix the neutral style. Throws
// Error when the model was learnt without trajectory statistics or has no body.
Clip stepped_walk(const std::shared_ptr<const Model>& model, const StyledWalkPlan& plan);

struct SpeedWalkPlan {
  double from = 0, to = 0;  // m/s; when they differ, speed goes evenly from one to the other
                            // between the first and the last tenth of the time
  double leg_length = 0;    // thigh and shank; 0: the subject's own
  std::string subject;      // empty: the mean of all
  SpeedLaw law = SpeedLaw::feet;
  double seconds = 5;
  double turn = 0;        // as above
  double frame_rate = 0;  // 0: the model's
};

struct SpeedWalk {
  Clip clip;  // its bones as long as the legs ask
  double leg_length = 0;
  std::vector<double> phase;         // per frame, 0 at the right contact
  std::vector<float> speed;          // per frame: reached by then
  std::vector<std::string> remarks;  // what was clamped
};

// A walk over speed (G04 §4); one that does not begin standing is under way. Throws Error when the
// model has no walks over speed, or no such subject (listing those it has).
SpeedWalk speed_walk(const PlayModel& played, const SpeedWalkPlan& plan);

}  // namespace gait
