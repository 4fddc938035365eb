// What style walkers of one model share and never change: the cycles of its space of styles, and
// how they vary in each style (T10 §6).
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "gait/model/model.h"
#include "gait/play/cycles/cycle_pose.h"
#include "gait/play/cycles/hinge_limits.h"

namespace gait {

struct StyleTables {
  explicit StyleTables(const Body& body) : hinges(body) {}

  std::shared_ptr<const CycleTables> cycles;
  HingeLimits hinges;
  // Columns are styles; rows are scores and then the duration.
  Eigen::MatrixXf means, deviations, limits;
  Eigen::MatrixXf ranges;                 // rows: lowest and highest duration
  std::vector<Eigen::MatrixXf> together;  // columns: rows of the correlations' Cholesky factor
  Eigen::VectorXf overall;                // mean of all styles
  float shortest = 0, longest = 0;        // cycle, however exaggerated
  Eigen::VectorXf component_deviations;   // over all cycles
  std::vector<bool> can_walk;             // per style
  Eigen::VectorXf neutral;                // weights of the neutral walk
};

// Throws Error when the model has no style space or no body, saying how to train one that has.
std::shared_ptr<const StyleTables> make_style_tables(const Model& model);

}  // namespace gait
