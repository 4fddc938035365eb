// What speed walkers of one model share and never change: its subjects' cycles over speed (G04
// §4.1), and how far their feet carry them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "gait/model/model.h"

namespace gait {

// Speeds are V = v / leg length throughout; strides are in leg lengths.
struct SubjectCyclesOverSpeed {
  std::string subject;
  float leg_length = 0;            // the captured one, metres
  float slowest = 0, fastest = 0;  // captured
  float frequency_scale = 0, frequency_power = 0;
  // Cycles as pose vectors, one column per frame: standing, equal
  // shares of the stride up to that at the slowest captured speed, equal steps of V from there to
  // highest_speed_per_leg on the subject's lines.
  std::vector<Eigen::MatrixXf> cycles;
  int slow_steps = 0;  // from standing to the slowest captured speed
  // What the feet travel in a cycle, over V^stride_power, at multiples of stride_grid; the limit
  // at 0.
  std::vector<float> strides;
};

struct SpeedTables {
  int frames = 0;                              // per cycle
  std::vector<int> joints;                     // of the body
  std::vector<Eigen::Quaternionf> references;  // one per joint of the body
  float leg_length = 0;                        // of the model's body, metres
  std::vector<SubjectCyclesOverSpeed> subjects;
};

inline constexpr float highest_speed = 10 / 3.6f;     // m/s
inline constexpr float highest_speed_per_leg = 3.8f;  // V: 10 km/h on a leg of 0.73 m
// Stride is V over frequency and grows as V^(1 - power of the frequency law).
inline constexpr float stride_power = 0.6f;
inline constexpr float stride_grid = 0.1f;  // V

// How far the stride has grown from standing (0) to the slowest captured speed (1): as stride grows
// with V. With G04's straight line instead, feet and cadence disagree the more the slower the walk.
float share_of_stride(float speed_per_leg, float slowest) noexcept;
float speed_of_share(float share, float slowest) noexcept;  // and back

// A subject's cycle at V is a * first + b * second of these; nothing is copied.
struct CyclesAround {
  const Eigen::MatrixXf *first, *second;
  float a, b;
};
CyclesAround cycles_around(const SubjectCyclesOverSpeed& subject, float speed_per_leg) noexcept;

// Leg lengths that the feet travel per cycle.
float stride_at(const SubjectCyclesOverSpeed& subject, float speed_per_leg) noexcept;

// Makes the cycles and lets every subject walk by his feet (RootMotion) at all speeds, at this
// many frames per second: a path from the feet depends on it by up to a percent. Throws Error when
// the model has no body or no speed spaces, saying how to train one that has.
std::shared_ptr<const SpeedTables> make_speed_tables(const Model& model, double frame_rate = 60);

}  // namespace gait
