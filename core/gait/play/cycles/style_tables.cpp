#include "gait/play/cycles/style_tables.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

namespace gait {

namespace {

constexpr double of_its_own = 0.1;      // share of each number's variance that is its own
constexpr float beyond_styles = 0.25f;  // of all styles' range: exaggerated durations stay within
constexpr float beyond_range = 0.1f;    // of the observed range's ends: durations stay within

Eigen::VectorXf even_weights(const StyleSpace& space) {
  Eigen::VectorXf weights(static_cast<Eigen::Index>(space.styles.size()));
  for (Eigen::Index i = 0; i < weights.size(); ++i)
    weights[i] = space.styles[static_cast<std::size_t>(i)].cycles > 0 ? 1.0f : 0.0f;
  return weights / weights.sum();
}

Eigen::VectorXf neutral_weights(const Model& model) {
  const StyleSpace& space = *model.style_space;
  for (std::size_t i = 0; i < model.styles.size(); ++i)
    if ((model.styles[i] == "neutral" || model.styles[i] == "normal") && space.styles[i].cycles > 0)
      return Eigen::VectorXf::Unit(static_cast<Eigen::Index>(model.styles.size()),
                                   static_cast<Eigen::Index>(i));
  return even_weights(space);
}

}  // namespace

std::shared_ptr<const StyleTables> make_style_tables(const Model& model) {
  auto cycles = make_cycle_tables(model);
  auto tables = std::make_shared<StyleTables>(*model.body);
  StyleTables& made = *tables;
  made.cycles = std::move(cycles);
  const StyleSpace& space = *model.style_space;
  const int components = space.space.kept();
  const auto styles = static_cast<Eigen::Index>(space.styles.size());
  made.means = made.deviations = made.limits = Eigen::MatrixXf::Zero(components + 1, styles);
  made.ranges = Eigen::MatrixXf::Zero(2, styles);
  for (Eigen::Index s = 0; s < styles; ++s) {
    const StyleCycles& style = space.styles[static_cast<std::size_t>(s)];
    for (int i = 0; i <= components; ++i) {
      const Variation& variation =
          i < components ? style.scores[static_cast<std::size_t>(i)] : style.duration;
      made.means(i, s) = static_cast<float>(variation.mean);
      made.deviations(i, s) = static_cast<float>(variation.deviation);
      made.limits(i, s) = static_cast<float>(variation.largest_change);
    }
    const Eigen::MatrixXd shrunk =
        (1 - of_its_own) * style.correlation +
        of_its_own * Eigen::MatrixXd::Identity(components + 1, components + 1);
    const Eigen::LLT<Eigen::MatrixXd> factor(shrunk);
    made.together.push_back(Eigen::MatrixXd(factor.matrixU()).cast<float>());
    made.ranges(0, s) = static_cast<float>(style.duration.lowest) * (1 - beyond_range);
    made.ranges(1, s) = static_cast<float>(style.duration.highest) * (1 + beyond_range);
  }
  made.overall = made.means * even_weights(space);
  made.shortest = made.longest = made.overall[components];
  for (Eigen::Index s = 0; s < styles; ++s) {
    if (space.styles[static_cast<std::size_t>(s)].cycles == 0) continue;
    made.shortest = std::min(made.shortest, made.ranges(0, s) * (1 - beyond_styles));
    made.longest = std::max(made.longest, made.ranges(1, s) * (1 + beyond_styles));
  }
  made.component_deviations = space.space.variances.head(components).cwiseSqrt().cast<float>();
  for (const StyleCycles& style : space.styles) made.can_walk.push_back(style.cycles > 0);
  made.neutral = neutral_weights(model);
  return tables;
}

}  // namespace gait
