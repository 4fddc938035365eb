// Cycle space: walks as points (T10 §4-6, G04 §3). A cycle is one long vector, its pose vectors at
// equal steps of phase one after another; principal components span what cycles differ in.
//
// Plain data: learn/ makes it, play/ walks in it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace gait {

struct CycleSpace {
  int frames = 40;             // per cycle; frame k is at phase k / frames (T10: 40, G04: 100)
  std::vector<int> joints;     // of the body, ascending; three values each
  Eigen::VectorXd mean;        // frame after frame, joint after joint: frames * joints * 3 values
  Eigen::MatrixXd components;  // values by kept components, orthonormal columns
  Eigen::VectorXd variances;   // of all components, kept or not, descending

  int values() const { return frames * 3 * static_cast<int>(joints.size()); }
  int kept() const { return static_cast<int>(components.cols()); }
  // How many components carry `share` of the variance, 0..1.
  int components_for(double share) const;
};

// How a number varies from cycle to cycle.
struct Variation {
  double mean = 0, deviation = 0;
  double largest_change = 0;  // between neighbouring cycles of one straight walk
  double lowest = 0, highest = 0;
};

// One style in a cycle space (T10 §6).
struct StyleCycles {
  int cycles = 0;                 // that it was learnt from; 0: none was straight, it cannot walk
  std::vector<Variation> scores;  // per kept component
  Variation duration;             // seconds
  Eigen::MatrixXd correlation;    // between scores and, last, duration; from cycle to cycle
  Eigen::MatrixXd projected;      // scores by cycles, for figures
  Eigen::VectorXd durations;      // and their seconds
};

// All styles in one space.
struct StyleSpace {
  CycleSpace space;
  int cycles_per_style = 0;         // that the components were fitted to; all were projected
  std::vector<StyleCycles> styles;  // in the model's order of styles
};

// Lines of a subject's scores over speed, in a space that subjects share.
struct SharedLines {
  Eigen::VectorXd intercept, slope, standing;  // as in SpeedSpace; empty: no shared space
  Eigen::MatrixXd projected;
};

// One subject's walks over speed (G04 §4), in a space of its own.
struct SpeedSpace {
  std::string subject;
  double leg_length = 0;  // thigh + shank, metres
  CycleSpace space;
  int cycles = 0;
  // Score i at dimensionless speed V = v / leg length: intercept + slope * V.
  Eigen::VectorXd intercept, slope;  // per kept component
  Eigen::VectorXd standing;          // scores of standing, V = 0
  double slowest = 0, fastest = 0;   // captured V
  // The captured cycles, for figures: V, cycles per second, scores by cycles.
  Eigen::VectorXd speeds, frequencies;
  Eigen::MatrixXd projected;
  // Cycles per second at V: scale * V^power (G04 eq. 6).
  double frequency_scale = 0, frequency_power = 0;
  SharedLines shared;  // in the model's shared_speed_space
};

}  // namespace gait
