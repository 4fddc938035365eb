// The built-in figures against the file they come from, and the neutral walk against the figures.
#include "gait/corpus/mean_gait.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "gait/motion/rotation.h"
#include "shared_data.h"
#include "walked_body.h"

namespace gait {
namespace {

TEST(MeanGait, built_in_figures_are_those_of_the_file) {
  GAIT_NEEDS_SHARED_DATA("mean-gait.json");
  const auto file = nlohmann::json::parse(std::ifstream(testing::shared_data() / "mean-gait.json"));
  const std::vector<std::pair<std::string, MeanJoint>> joints{
      {"Hips", MeanJoint::hips},        {"Spine", MeanJoint::spine},
      {"Spine1", MeanJoint::spine1},    {"Spine2", MeanJoint::spine2},
      {"Neck", MeanJoint::neck},        {"Head", MeanJoint::head},
      {"LeftArm", MeanJoint::left_arm}, {"LeftForeArm", MeanJoint::left_forearm},
      {"LeftLeg", MeanJoint::left_knee}};
  for (const auto& [name, joint] : joints) {
    const auto entry = std::find_if(file["joints"].begin(), file["joints"].end(),
                                    [&](const auto& j) { return j["name"] == name; });
    ASSERT_NE(entry, file["joints"].end()) << name;
    for (const double speed : {1.0, 1.6, 2.2})
      for (const double phase : {0.0, 0.13, 0.5, 0.77}) {
        Eigen::Vector3d expected = Eigen::Vector3d::Zero();
        for (int axis = 0; axis < 3; ++axis)
          for (int term = 0; term < 9; ++term) {
            const int harmonic = (term + 1) / 2;
            const double angle = 2 * std::acos(-1.0) * harmonic * (phase + mean_gait_lead);
            const double basis = term == 0 ? 1 : term % 2 == 1 ? std::cos(angle) : std::sin(angle);
            expected[axis] +=
                basis * ((*entry)["at_reference"][axis][term].get<double>() +
                         (speed - 1.6) * (*entry)["per_unit_speed"][axis][term].get<double>());
          }
        EXPECT_LT((MeanGaitCurve(joint, speed).at(phase) - expected).norm(), 1e-9) << name;
      }
  }
}

TEST(MeanGait, a_neutral_walk_bends_its_knees_as_the_mean_gait) {
  WalkPlan plan{.style = corpus_style("neutral")};
  plan.cycles = 8;
  const CorpusWalk walk = make_walk(plan);
  const MeanGaitCurve curve(MeanJoint::left_knee, plan.style.speed);
  const auto knee = static_cast<std::size_t>(walk.clip.skeleton.find("LeftLeg"));
  double bias = 0, squares = 0, mean_squares = 0;
  const auto frames = static_cast<std::size_t>(walk.clip.frames());
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const double drawn = rotation_vector(walk.clip.pose(static_cast<int>(frame))[knee]).x();
    const double mean = curve.at(walk.phase[frame]).x();
    bias += (drawn - mean) / static_cast<double>(frames);
    squares += (drawn - mean) * (drawn - mean) / static_cast<double>(frames);
    mean_squares +=
        (mean - curve.mean().x()) * (mean - curve.mean().x()) / static_cast<double>(frames);
  }
  // The legs come from the feet by inverse kinematics, yet the knee's curve is the mean gait's:
  // straighter by some degrees as the style says, and with a tenth of its variance unexplained.
  EXPECT_NEAR(bias, -0.08, 0.06);
  EXPECT_LT((squares - bias * bias) / mean_squares, 0.10);
}

}  // namespace
}  // namespace gait
