// The speed walker against captured walks of many speeds (G04 §5): speeds left out are foretold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "gait/motion/rotation.h"
#include "judge/captured_speeds.h"
#include "shared_data.h"

namespace gait {
namespace {

using testing::captured;
using testing::model_of;
using testing::whole_model;

constexpr double degrees = 180 / std::numbers::pi;

// The mean of a clip's cycles.
struct ClipCycle {
  std::size_t subject = 0;
  int walk = 0, cycles = 0;
  double speed = 0, frequency = 0;  // m/s, cycles per second
  Eigen::VectorXd values;
};

std::vector<ClipCycle> clip_cycles(std::size_t subject) {
  std::map<int, ClipCycle> clips;
  for (const CapturedCycle& cycle : captured().subjects[subject].cycles) {
    ClipCycle& clip = clips[cycle.walk];
    if (clip.cycles++ == 0) clip.values = Eigen::VectorXd::Zero(cycle.values.size());
    clip.subject = subject;
    clip.walk = cycle.walk;
    clip.values += cycle.values;
    clip.speed += cycle.speed;
    clip.frequency += 1 / cycle.duration;
  }
  std::vector<ClipCycle> result;
  for (auto& [walk, clip] : clips) {
    clip.values /= clip.cycles, clip.speed /= clip.cycles, clip.frequency /= clip.cycles;
    result.push_back(clip);
  }
  return result;
}

std::size_t subject_named(const std::string& name) {
  std::size_t at = 0;
  while (captured().subjects[at].subject != name) ++at;
  return at;
}

// What was learnt without some clips of one subject, of whom alone it can walk.
std::shared_ptr<Model> model_without(std::size_t subject, const std::set<int>& clips) {
  std::vector<SubjectCycles> subjects = captured().subjects;
  std::erase_if(subjects[subject].cycles,
                [&](const CapturedCycle& cycle) { return clips.count(cycle.walk) > 0; });
  auto model = model_of(subjects);
  std::erase_if(model->speed_spaces, [&](const SpeedSpace& space) {
    return space.subject != captured().subjects[subject].subject;
  });
  return model;
}

Eigen::VectorXd on_the_lines(const Model& model, double speed) {
  const SpeedSpace& space = model.speed_spaces.front();
  return space.space.mean +
         space.space.components * (space.intercept + speed / space.leg_length * space.slope);
}

Eigen::VectorXd as_walked(const SpeedTables& tables, double speed) {
  const CyclesAround around = cycles_around(
      tables.subjects.front(), static_cast<float>(speed) / tables.subjects.front().leg_length);
  const Eigen::MatrixXd cycle =
      (around.a * *around.first + around.b * *around.second).cast<double>();
  return Eigen::Map<const Eigen::VectorXd>(cycle.data(), cycle.size());
}

using JointChoice = std::function<bool(int)>;  // place among the space's joints

// Angles between two cycles' joints, degrees: mean, and root of the mean square.
std::pair<double, double> apart(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                                const JointChoice& chosen) {
  const auto joints = static_cast<int>(whole_model()->shared_speed_space->joints.size());
  double sum = 0, squares = 0;
  int count = 0;
  for (Eigen::Index i = 0; i < a.size(); i += 3) {
    if (!chosen(static_cast<int>(i / 3) % joints)) continue;
    const double angle =
        degrees * angle_between(exponential_map<double>(Eigen::Vector3d(a.segment<3>(i))),
                                exponential_map<double>(Eigen::Vector3d(b.segment<3>(i))));
    sum += angle, squares += angle * angle, ++count;
  }
  return {sum / count, std::sqrt(squares / count)};
}

double mean_error(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return apart(a, b, [](int) { return true; }).first;
}

double leg_error(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const auto& joints = whole_model()->shared_speed_space->joints;
  const auto& roles = captured().body.roles;
  return apart(a, b,
               [&](int place) {
                 const Role role = roles[joints[place]];
                 return role == Role::left_thigh || role == Role::left_shank ||
                        role == Role::left_foot || role == Role::right_thigh ||
                        role == Role::right_shank || role == Role::right_foot;
               })
      .second;
}

TEST(SpeedRealData, a_speed_left_out_is_foretold) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  double lines = 0, walked = 0, nearest = 0, mean = 0;
  int count = 0;
  std::vector<double> cadence_errors;
  for (const char* name : {"08", "16", "35"}) {
    const auto clips = clip_cycles(subject_named(name));
    for (const ClipCycle& left_out : clips) {
      std::set<int> gone;
      std::vector<const ClipCycle*> rest;
      for (const ClipCycle& clip : clips)
        if (std::abs(clip.speed - left_out.speed) <= 0.05)
          gone.insert(clip.walk);
        else
          rest.push_back(&clip);
      const auto slower = [](const auto* a, const auto* b) { return a->speed < b->speed; };
      const auto [low, high] = std::minmax_element(rest.begin(), rest.end(), slower);
      if (rest.size() < 2 || left_out.speed < (*low)->speed || left_out.speed > (*high)->speed)
        continue;
      const auto model = model_without(left_out.subject, gone);
      const auto tables = make_speed_tables(*model, 120);
      const ClipCycle& near =
          **std::min_element(rest.begin(), rest.end(), [&](const auto* a, const auto* b) {
            return std::abs(a->speed - left_out.speed) < std::abs(b->speed - left_out.speed);
          });
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(left_out.values.size());
      for (const ClipCycle* clip : rest) sum += clip->values;
      lines += mean_error(on_the_lines(*model, left_out.speed), left_out.values);
      walked += mean_error(as_walked(*tables, left_out.speed), left_out.values);
      nearest += mean_error(near.values, left_out.values);
      mean += mean_error(sum / static_cast<double>(rest.size()), left_out.values);
      ++count;
      SpeedWalker walking(tables);
      walking.set_speed(static_cast<float>(left_out.speed));
      walking.settle();
      walking.advance(1e-3);
      cadence_errors.push_back(std::abs(walking.frequency() / left_out.frequency - 1));
    }
  }
  ASSERT_GE(count, 20);
  std::printf("left out: %d clips, lines %.3f, as walked %.3f, nearest %.3f, mean %.3f degrees\n",
              count, lines / count, walked / count, nearest / count, mean / count);
  EXPECT_LT(lines, nearest);
  EXPECT_LT(lines, 1.03 * mean);
  EXPECT_LT(walked, nearest);
  EXPECT_LT(walked, 1.03 * mean);
  std::sort(cadence_errors.begin(), cadence_errors.end());
  std::printf("cadence by the feet: median error %.3f\n", cadence_errors[count / 2]);
  EXPECT_LT(cadence_errors[count / 2], 0.08);
}

TEST(SpeedRealData, far_speeds_are_nearer_to_the_lines_than_to_the_middle) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  double lines = 0, walked = 0, middle = 0;
  int count = 0;
  for (const char* name : {"08", "16"}) {
    const auto clips = clip_cycles(subject_named(name));
    for (const ClipCycle& left_out : clips) {
      if (std::abs(left_out.speed - 1.35) < 0.2) continue;
      Eigen::VectorXd sums[2];
      int counts[2] = {};
      for (const ClipCycle& clip : clips) {
        if (clip.walk == left_out.walk) continue;
        const int side = clip.speed < 1.35 ? 0 : 1;
        if (counts[side]++ == 0) sums[side] = Eigen::VectorXd::Zero(clip.values.size());
        sums[side] += clip.values;
      }
      if (counts[0] == 0 || counts[1] == 0) continue;
      const auto model = model_without(left_out.subject, {left_out.walk});
      lines += leg_error(on_the_lines(*model, left_out.speed), left_out.values);
      walked += leg_error(as_walked(*make_speed_tables(*model), left_out.speed), left_out.values);
      middle += leg_error((sums[0] / counts[0] + sums[1] / counts[1]) / 2, left_out.values);
      ++count;
    }
  }
  ASSERT_GE(count, 8);
  std::printf("far: %d clips, lines %.3f, as walked %.3f, middle %.3f degrees\n", count,
              lines / count, walked / count, middle / count);
  EXPECT_LT(lines, 0.9 * middle);
  EXPECT_LT(walked, 0.9 * middle);
}

}  // namespace
}  // namespace gait
