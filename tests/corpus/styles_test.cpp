// Styles can be told apart from the upper body alone, and not by one number.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <map>

#include "gait/motion/rotation.h"
#include "walked_body.h"

namespace gait {
namespace {

constexpr int phases = 8, upper_joints = 11;  // spine to right forearm; the hips belong to the legs
using Cycle = Eigen::Matrix<double, phases * upper_joints * 3, 1>;

struct LabelledCycle {
  std::string style;
  int take;
  Cycle pose;
};

// Each cycle as rotation vectors at eight phases.
std::vector<LabelledCycle> upper_body_cycles() {
  std::vector<LabelledCycle> cycles;
  for (const CorpusWalk& walk : testing::corpus())
    for (const auto& [begin, end] : cycles_between(walk.contacts)) {
      LabelledCycle cycle{walk.style, walk.take, {}};
      for (int k = 0; k < phases; ++k) {
        const int frame = begin + (end - begin) * k / phases;
        for (int j = 0; j < upper_joints; ++j)
          cycle.pose.segment<3>(3 * (k * upper_joints + j)) =
              rotation_vector(walk.clip.pose(frame)[static_cast<std::size_t>(j) + 1]);
      }
      cycles.push_back(cycle);
    }
  return cycles;
}

TEST(CorpusStyles, a_cycle_is_nearest_to_the_mean_of_its_own_style_in_other_takes) {
  const auto cycles = upper_body_cycles();
  int right = 0;
  for (const LabelledCycle& unknown : cycles) {
    std::map<std::string, std::pair<Cycle, int>> sums;
    for (const LabelledCycle& known : cycles) {
      if (known.style == unknown.style && known.take == unknown.take) continue;
      auto [place, fresh] = sums.try_emplace(known.style, Cycle::Zero(), 0);
      place->second.first += known.pose;
      ++place->second.second;
    }
    std::string nearest;
    double least = 1e9;
    for (const auto& [style, sum] : sums) {
      const double distance = (sum.first / sum.second - unknown.pose).norm();
      if (distance < least) least = distance, nearest = style;
    }
    right += nearest == unknown.style;
  }
  EXPECT_GT(right, 0.95 * static_cast<double>(cycles.size()));
}

TEST(CorpusStyles, each_pair_differs_in_several_joints) {
  std::map<std::string, std::pair<Cycle, int>> sums;
  for (const LabelledCycle& cycle : upper_body_cycles()) {
    auto [place, fresh] = sums.try_emplace(cycle.style, Cycle::Zero(), 0);
    place->second.first += cycle.pose;
    ++place->second.second;
  }
  for (const auto& [a, sum_a] : sums)
    for (const auto& [b, sum_b] : sums) {
      if (a >= b) continue;
      const Cycle difference = sum_a.first / sum_a.second - sum_b.first / sum_b.second;
      int joints = 0;
      for (int j = 0; j < upper_joints; ++j) {
        double squares = 0;
        for (int k = 0; k < phases; ++k)
          squares += difference.segment<3>(3 * (k * upper_joints + j)).squaredNorm() / phases;
        joints += std::sqrt(squares) > 0.05;  // three degrees
      }
      EXPECT_GE(joints, 3) << a << " and " << b;
    }
}

TEST(CorpusStyles, drunk_cycles_vary_most) {
  std::map<std::string, std::vector<Cycle>> cycles;
  for (const LabelledCycle& cycle : upper_body_cycles()) cycles[cycle.style].push_back(cycle.pose);
  std::map<std::string, double> spread;
  for (const auto& [style, poses] : cycles) {
    Cycle mean = Cycle::Zero();
    for (const Cycle& pose : poses) mean += pose / static_cast<double>(poses.size());
    for (const Cycle& pose : poses)
      spread[style] += (pose - mean).squaredNorm() / static_cast<double>(poses.size());
  }
  for (const auto& [style, variance] : spread) {
    EXPECT_GT(variance, 0) << style;
    if (style != "drunk") {
      EXPECT_GT(spread["drunk"], 2 * variance) << style;
    }
  }
}

}  // namespace
}  // namespace gait
