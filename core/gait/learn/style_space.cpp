#include "gait/learn/style_space.h"

#include <algorithm>
#include <cmath>

#include "gait/error.h"

namespace gait {

namespace {

using Cycles = std::vector<const CapturedCycle*>;

// First n of each style, one per row.
Eigen::MatrixXd first_of_each(const std::vector<Cycles>& of_style, std::size_t n) {
  std::size_t rows = 0;
  Eigen::Index values = 0;
  for (const Cycles& cycles : of_style)
    if (!cycles.empty()) rows += n, values = cycles.front()->values.size();
  Eigen::MatrixXd matrix(rows, values);
  Eigen::Index row = 0;
  for (const Cycles& cycles : of_style)
    for (std::size_t i = 0; i < n && i < cycles.size(); ++i)
      matrix.row(row++) = cycles[i]->values.transpose();
  return matrix;
}

// Between the scores and, last, the duration. What does not vary correlates with nothing.
Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& scores, const Eigen::VectorXd& durations) {
  Eigen::MatrixXd values(scores.rows(), scores.cols() + 1);
  values << scores, durations;
  const Eigen::Index size = values.cols();
  if (values.rows() < 2) return Eigen::MatrixXd::Identity(size, size);
  values.rowwise() -= values.colwise().mean().eval();
  for (Eigen::Index i = 0; i < size; ++i)
    if (const double norm = values.col(i).norm(); norm > 1e-12) values.col(i) /= norm;
  Eigen::MatrixXd correlation = values.transpose() * values;
  correlation.diagonal().setOnes();
  return correlation;
}

// How `values`, one per cycle in the order of `cycles`, vary (all of one style).
Variation variation_over(const Cycles& cycles, const Eigen::Ref<const Eigen::VectorXd>& values) {
  const auto count = static_cast<double>(values.size());
  Variation variation;
  variation.mean = values.mean();
  if (values.size() > 1)
    variation.deviation = std::sqrt((values.array() - variation.mean).square().sum() / (count - 1));
  variation.lowest = values.minCoeff();
  variation.highest = values.maxCoeff();
  bool neighbours = false;
  for (std::size_t i = 1; i < cycles.size(); ++i)
    if (cycles[i]->walk == cycles[i - 1]->walk && cycles[i]->place == cycles[i - 1]->place + 1) {
      const auto at = static_cast<Eigen::Index>(i);
      variation.largest_change =
          std::max(variation.largest_change, std::abs(values[at] - values[at - 1]));
      neighbours = true;
    }
  if (!neighbours) variation.largest_change = variation.highest - variation.lowest;
  return variation;
}

StyleCycles style_cycles(const Cycles& cycles, const CycleSpace& space) {
  StyleCycles style;
  style.cycles = static_cast<int>(cycles.size());
  Eigen::MatrixXd scores(style.cycles, space.kept());
  Eigen::VectorXd durations(style.cycles);
  for (int i = 0; i < style.cycles; ++i) {
    // Eq. 1, for the cycles that were not fitted too.
    scores.row(i).noalias() = (cycles[i]->values - space.mean).transpose() * space.components;
    durations[i] = cycles[i]->duration;
  }
  for (int i = 0; i < space.kept(); ++i)
    style.scores.push_back(style.cycles == 0 ? Variation{} : variation_over(cycles, scores.col(i)));
  if (style.cycles > 0) style.duration = variation_over(cycles, durations);
  style.correlation = correlation_of(scores, durations);
  style.projected = scores.transpose();
  style.durations = std::move(durations);
  return style;
}

}  // namespace

StyleSpace learn_style_space(const std::vector<CapturedCycle>& cycles,
                             const std::vector<int>& style_of_walk, int styles,
                             const std::vector<int>& joints, int frames,
                             const ComponentChoice& choice) {
  std::vector<Cycles> of_style(styles);
  for (const CapturedCycle& cycle : cycles)
    if (const int style = style_of_walk[cycle.walk]; cycle.straight && style >= 0)
      of_style[style].push_back(&cycle);
  std::size_t fewest = 0;
  for (const Cycles& of : of_style)
    if (!of.empty()) fewest = fewest == 0 ? of.size() : std::min(fewest, of.size());

  StyleSpace result;
  Eigen::MatrixXd rows = first_of_each(of_style, fewest);
  PrincipalComponents found = principal_components(rows, choice);
  result.cycles_per_style = static_cast<int>(fewest);
  result.space = {.frames = frames,
                  .joints = joints,
                  .mean = std::move(found.mean),
                  .components = std::move(found.components),
                  .variances = std::move(found.variances)};
  for (const Cycles& of : of_style) result.styles.push_back(style_cycles(of, result.space));
  return result;
}

}  // namespace gait
