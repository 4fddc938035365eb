#include "gait/learn/state_statistics.h"

#include "gait/learn/parallel.h"

namespace gait {

StateStatistics::StateStatistics(int dimensions, int styles)
    : sum(Eigen::VectorXd::Zero(dimensions)),
      products(Eigen::MatrixXd::Zero(dimensions, dimensions)),
      style_counts(Eigen::VectorXd::Zero(styles)),
      style_sums(Eigen::MatrixXd::Zero(dimensions, styles)) {}

StateStatistics& StateStatistics::operator+=(const StateStatistics& other) {
  count += other.count;
  sum += other.sum;
  products += other.products;
  style_counts += other.style_counts;
  style_sums += other.style_sums;
  return *this;
}

StateStatistics& StateStatistics::operator-=(const StateStatistics& other) {
  count -= other.count;
  sum -= other.sum;
  products -= other.products;
  style_counts -= other.style_counts;
  style_sums -= other.style_sums;
  return *this;
}

Eigen::MatrixXd StateStatistics::covariance() const {
  return products / count - mean() * mean().transpose();
}

Eigen::MatrixXd StateStatistics::within_style_covariance(int dimensions) const {
  Eigen::MatrixXd within = products.topLeftCorner(dimensions, dimensions);
  double styled = 0;
  for (int style = 0; style < style_counts.size(); ++style) {
    // Cycles of rounding after leaving a fold out can make a count of none slightly negative.
    if (style_counts[style] < 1e-6) continue;
    const Eigen::VectorXd part = style_sums.col(style).head(dimensions);
    within -= part * part.transpose() / style_counts[style];
    styled += style_counts[style];
  }
  // Frames without a style scatter about the common mean of what is left.
  const double unstyled = count - styled;
  if (unstyled > 1e-6) {
    const Eigen::VectorXd rest =
        sum.head(dimensions) - style_sums.topRows(dimensions).rowwise().sum();
    within -= rest * rest.transpose() / unstyled;
  }
  return within / count;
}

std::vector<StateStatistics> gather(const std::vector<ObservedSequence>& sequences,
                                    const std::vector<Alignment>& alignments,
                                    const std::vector<int>& chosen, int states, int styles,
                                    int threads) {
  std::vector<StateStatistics> statistics(states);
  const int inputs = static_cast<int>(sequences.front().x.rows());
  const int outputs = static_cast<int>(sequences.front().y.rows());
  in_parallel(states, threads, [&](int state) {
    StateStatistics& mine = statistics[state];
    mine = StateStatistics(inputs + outputs, styles);
    int frames = 0;
    for (const int i : chosen)
      for (const Occupancy& at : alignments[i].occupancies) frames += at.state == state;
    Eigen::MatrixXd weighted(inputs + outputs, frames);  // z times the square root of its share
    int column = 0;
    for (const int i : chosen)
      for (const Occupancy& at : alignments[i].occupancies) {
        if (at.state != state) continue;
        const double root = std::sqrt(at.share);
        auto z = weighted.col(column++);
        z.head(inputs) = root * sequences[i].x.col(at.frame);
        z.tail(outputs) = root * sequences[i].y.col(at.frame);
        mine.count += at.share;
        mine.sum += root * z;
        if (sequences[i].style >= 0) {
          mine.style_counts[sequences[i].style] += at.share;
          mine.style_sums.col(sequences[i].style) += root * z;
        }
      }
    if (frames == 0) return;  // Eigen divides by the number of columns of a large product
    mine.products.selfadjointView<Eigen::Lower>().rankUpdate(weighted);
    mine.products.triangularView<Eigen::StrictlyUpper>() = mine.products.transpose();
  });
  return statistics;
}

}  // namespace gait
