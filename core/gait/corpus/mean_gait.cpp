#include "gait/corpus/mean_gait.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace gait {
namespace {

constexpr double reference_speed = 1.6;

struct Series {
  double at_reference[3][9];
  double per_unit_speed[3][9];
};

// In the order of MeanJoint.
// clang-format off
constexpr std::array<Series, 9> series{{
    // Hips
    {{{0.07106, 0.00089, 0.00327, 0.0179, 0.00405, -2e-05, 0.00027, 0.00329, 1e-05},
       {0.00306, 0.07457, 0.04125, 0.00033, -0.00014, 0.00686, -0.00344, -0.00041, 7e-05},
       {0.0021, 0.075, -0.04482, -0.00024, 9e-05, 0.01882, 0.00956, -0.00022, -0.00061}},
     {{0.08363, -0.00102, -0.0053, 0.00192, -0.01423, -0.00111, -0.00171, 0.00377, 0.00025},
       {0.0144, 0.07923, -0.00425, 0.00218, -0.01087, 0.0099, -0.02574, -0.00068, -0.00537},
       {0.00247, -0.03106, 0.01467, -0.00103, -0.00016, 0.01055, -0.00526, 0.00103, -0.00034}}},
    // Spine
    {{{0.02256, -0.00085, 0.00103, -0.00856, -0.01061, 0.00017, 0.00118, -0.00113, -0.00067},
       {-0.00069, -0.04279, -0.01377, -2e-05, 8e-05, 0.00094, -0.00092, 0.00014, -2e-05},
       {-0.00098, -0.08121, 0.04312, -0.00038, 0.00026, -0.0203, -0.00502, 0.00042, 0.0004}},
     {{-0.08847, 0.00024, 0.00351, -0.01607, 0.02006, 0.00036, -0.00034, -0.00576, -0.00725},
       {-0.00209, -0.01994, -0.00643, 0.00024, 0.00071, -0.00114, 0.00185, 0.00013, 0.0003},
       {-0.00025, 0.036, 0.01863, 0.00012, 0.0023, -0.02006, 0.0142, -0.00071, 0.00167}}},
    // Spine1
    {{{-0.02125, -0.00026, -0.00052, 0.00026, -0.00262, 9e-05, 0.00027, 0.00106, 1e-05},
       {-0.00094, -0.05756, -0.01788, -4e-05, 0.00011, 0.00114, -0.00129, 0.00019, -1e-05},
       {-0.00119, -0.00614, 0.02635, 0.00011, 0.00027, -0.00786, -0.00309, -3e-05, 0.00047}},
     {{-0.00245, 0.00115, -0.00044, -0.00402, 0.00704, 0.0005, -0.00019, 6e-05, -0.0034},
       {-0.00285, -0.02544, -0.00846, 0.00033, 0.00101, -0.00155, 0.00274, 0.00016, 0.00039},
       {-0.00285, 0.01158, 0.0066, 0.00069, 0.0005, -0.00384, 0.00132, -0.00068, 0.00016}}},
    // Spine2
    {{{-0.03303, 0.00026, -0.00121, 0.00754, 0.00316, 1e-05, -0.0004, 0.00207, 0.00076},
       {-0.00046, -0.0284, -0.00924, -2e-05, 6e-05, 0.00067, -0.00061, 9e-05, -1e-05},
       {-0.00063, 0.04022, 0.00331, 0.00029, 0.00021, 0.00272, -0.00057, -0.00029, 0.00031}},
     {{0.04667, 0.00098, -0.00274, 0.0059, -0.00483, 0.00036, -0.00013, 0.00402, 0.00036},
       {-0.00144, -0.0135, -0.00431, 0.00013, 0.00047, -0.00076, 0.00114, 8e-05, 0.00018},
       {-0.00294, -0.01203, -0.00415, 0.00063, -0.00055, 0.00648, -0.00696, -0.00034, -0.00075}}},
    // Neck
    {{{0.07158, 0.00118, -0.01094, -0.00941, -0.01446, -0.00048, -0.00274, -0.0036, 0.00173},
       {0.0001, 0.01861, 0.00126, -0.00018, -0.0012, -0.0084, 0.00466, 0.0001, -0.00033},
       {0.0003, -0.00858, -0.01321, 2e-05, 5e-05, 0.00719, -0.0047, -5e-05, -0.00034}},
     {{-0.25301, -0.00078, 0.01292, 0.01147, -0.02202, -0.00035, 0.00473, 0.00347, 0.01394},
       {0.01825, -0.00031, 0.02173, -0.00081, 0.00296, -0.00555, 0.01271, 0.00036, 0.00069},
       {0.00227, -0.00381, -0.02119, -0.00159, -0.00073, 0.00375, -0.00721, 0.00069, -0.00106}}},
    // Head
    {{{0.14215, -0.00052, -0.00347, -0.00339, -0.0022, -0.00017, -0.00123, -0.00166, -8e-05},
       {3e-05, 0.00523, 0.00035, -5e-05, -0.00034, -0.00239, 0.00132, 3e-05, -0.0001},
       {-0.00325, -0.00059, -0.00465, -0.00019, -0.0001, 0.00227, -0.00103, -9e-05, -0.00024}},
     {{-0.10464, -0.00214, 0.00483, 0.00185, -0.00423, -0.00075, 0.0008, -8e-05, 0.00325},
       {0.00474, 0.00012, 0.00642, -0.00019, 0.00092, -0.00161, 0.0037, 0.00012, 0.00026},
       {-0.00776, 0.0035, -0.00465, -0.00024, 0.00024, 0.00118, -0.00101, 8e-05, 4e-05}}},
    // LeftArm
    {{{0.34574, 0.04997, 0.08143, -0.00412, -0.04778, -0.01914, -0.00444, 0.00044, 0.00432},
       {-0.17431, -0.34202, -0.11426, -0.01033, 0.07508, 0.00471, 0.00708, -0.01252, -0.00651},
       {-1.4542, 0.08365, -0.00025, 0.0456, 0.00736, 0.01475, -0.01053, -0.00132, -0.00194}},
     {{-0.00823, 0.09953, 0.12878, -0.02427, -0.07818, -0.03497, -0.02742, -0.00231, 0.01119},
       {0.03549, -0.43305, -0.22212, 0.05975, 0.09017, 0.01091, 0.03385, -0.01078, -0.00298},
       {0.0856, 0.05212, 0.02791, 0.06652, 0.06105, 0.01472, -0.01896, -0.00622, -0.00448}}},
    // LeftForeArm
    {{{0, 0, 0, 0, 0, 0, 0, 0, 0},
       {-0.46725, -0.17755, -0.07686, -0.04063, -0.00209, 0.00647, -0.00383, 0.00366, 0.00271},
       {0.26976, 0.10251, 0.04438, 0.02347, 0.00122, -0.00373, 0.00221, -0.00211, -0.00157}},
     {{0, 0, 0, 0, 0, 0, 0, 0, 0},
       {-0.03179, -0.24755, -0.15666, -0.01116, -0.06231, 0.01959, 0.00087, 0.01138, 0.00814},
       {0.01832, 0.14292, 0.09045, 0.00647, 0.036, -0.01131, -0.0005, -0.00658, -0.00471}}},
    // LeftLeg
    {{{0.60465, -0.11192, 0.26689, -0.31592, -0.03873, 0.01691, -0.10157, -0.04043, -0.00039},
       {0, 0, 0, 0, 0, 0, 0, 0, 0},
       {-1e-05, 1e-05, -1e-05, 0, 0, 0, -1e-05, 1e-05, 1e-05}},
     {{0.07229, 0.0185, 0.02968, -0.08211, 0.1196, -0.01487, -0.00548, -0.03205, -0.01843},
       {0, 0, 0, 0, 0, 0, 0, 0, 0},
       {0, 1e-05, 0, 0, 0, -1e-05, -1e-05, 0, 0}}},
}};
// clang-format on

// Offsets in leg lengths.
constexpr double thigh = 0.485, shank = 0.515;
const Eigen::Vector3d hip_joint(0.1117, -0.1207, 0.049);
const Eigen::Vector3d shoulder(0.0018, 0.1424, 0.0015);
const Eigen::Vector3d arm(0.2186, 0.076, -0.0208);
constexpr double upper_arm = 0.3462, forearm = 0.2288;
constexpr double ball = 0.1429, heel = 0.06, ankle_height = 0.075, crown = 0.17;

Eigen::Vector3d mirrored(const Eigen::Vector3d& offset) {
  return {-offset.x(), offset.y(), offset.z()};
}

}  // namespace

MeanGaitCurve::MeanGaitCurve(MeanJoint joint, double speed) {
  const Series& s = series[static_cast<std::size_t>(joint)];
  const double beyond = std::clamp(speed, mean_gait_slowest, mean_gait_fastest) - reference_speed;
  for (int axis = 0; axis < 3; ++axis)
    for (int term = 0; term < 9; ++term)
      coefficients_(axis, term) =
          s.at_reference[axis][term] + beyond * s.per_unit_speed[axis][term];
}

Eigen::Vector3d MeanGaitCurve::at(double phase) const {
  phase += mean_gait_lead;
  Eigen::Matrix<double, 9, 1> basis;
  basis[0] = 1;
  for (int harmonic = 1; harmonic <= 4; ++harmonic) {
    const double angle = 2 * std::numbers::pi * harmonic * (phase - std::floor(phase));
    basis[2 * harmonic - 1] = std::cos(angle);
    basis[2 * harmonic] = std::sin(angle);
  }
  return coefficients_ * basis;
}

double mean_gait_frequency(double speed) { return 0.7516 * std::pow(speed, 0.4077); }

Skeleton mean_body(double leg_length) {
  Skeleton body;
  const auto add = [&](const char* name, const char* parent,
                       const Eigen::Vector3d& offset) -> Joint& {
    return body.joints.emplace_back(Joint{name, body.find(parent), leg_length * offset, {}});
  };
  add("Hips", "", {0, 0, 0});
  add("Spine", "Hips", {0, 0, 0});
  add("Spine1", "Spine", {0.0004, 0.1403, -0.0069});
  add("Spine2", "Spine1", {0.002, 0.1408, -0.0017});
  add("Neck", "Spine2", shoulder);
  add("Head", "Neck", {0.001, 0.2253, -0.0027}).tips = {leg_length * Eigen::Vector3d(0, crown, 0)};
  for (const bool left : {true, false}) {
    const auto side = [&](const Eigen::Vector3d& v) { return left ? v : mirrored(v); };
    const std::string_view prefix = left ? "Left" : "Right";
    const auto named = [&](std::string_view part) { return std::string(prefix).append(part); };
    add(named("Shoulder").c_str(), "Spine2", shoulder);
    add(named("Arm").c_str(), named("Shoulder").c_str(), side(arm));
    add(named("ForeArm").c_str(), named("Arm").c_str(), side({upper_arm, 0, 0})).tips = {
        leg_length * side({forearm, 0, 0})};
  }
  for (const bool left : {true, false}) {
    const auto side = [&](const Eigen::Vector3d& v) { return left ? v : mirrored(v); };
    const std::string_view prefix = left ? "Left" : "Right";
    const auto named = [&](std::string_view part) { return std::string(prefix).append(part); };
    add(named("UpLeg").c_str(), "Hips", side(hip_joint));
    add(named("Leg").c_str(), named("UpLeg").c_str(), {0, -thigh, 0});
    add(named("Foot").c_str(), named("Leg").c_str(), {0, -shank, 0}).tips = {
        leg_length * Eigen::Vector3d(0, -ankle_height, ball),
        leg_length * Eigen::Vector3d(0, -ankle_height, -heel)};
  }
  return body;
}

}  // namespace gait
