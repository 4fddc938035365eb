#include "gait/judge/space_summary.h"

#include <algorithm>

namespace gait {

SpaceSummary summary_of(const CycleSpace& space, int cycles) {
  SpaceSummary summary{cycles, space.kept(), {}, {}};
  for (std::size_t i = 0; i < told_shares.size(); ++i) {
    summary.components[i] = space.components_for(told_shares[i]);
    summary.reduction[i] = static_cast<double>(cycles) / std::max(1, summary.components[i]);
  }
  return summary;
}

SpaceSummary summary_of(const StyleSpace& styles) {
  const auto walking = std::count_if(styles.styles.begin(), styles.styles.end(),
                                     [](const StyleCycles& style) { return style.cycles > 0; });
  return summary_of(styles.space, static_cast<int>(walking) * styles.cycles_per_style);
}

SpaceSummary summary_of(const SpeedSpace& subject) {
  return summary_of(subject.space, subject.cycles);
}

std::vector<double> cumulated_shares(const CycleSpace& space) {
  const double total = space.variances.sum();
  std::vector<double> shares{0};
  double sum = 0;
  for (const double variance : space.variances)
    shares.push_back(total > 0 ? (sum += variance) / total : 1);
  return shares;
}

}  // namespace gait
