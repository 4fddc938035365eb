// The speed walker against captured walks of many speeds (G04 §5): speeds left out are foretold,
// feet tell the truth, and nobody floats.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "gait/judge/foot_slide.h"
#include "gait/learn/speed_space.h"
#include "gait/model/body_pose.h"
#include "gait/motion/contacts.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"
#include "gait/play/root_motion.h"
#include "gait/play/speed_walker.h"
#include "judge/real_walks.h"
#include "shared_data.h"

namespace gait {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

struct Captured {
  std::vector<Walk> walks;
  Body body;
  std::vector<SubjectCycles> subjects;
};

const Captured& captured() {
  static const Captured all = [] {
    Captured made;
    made.walks = testing::real_walks("cmu-walks", [](const std::string&) { return true; });
    for (Walk& walk : made.walks)
      walk.subject = std::filesystem::path(walk.clip.name).filename().string().substr(0, 2);
    made.body = body_of_subjects(made.walks);
    made.subjects = cycles_of_subjects(made.walks, made.body);
    return made;
  }();
  return all;
}

std::shared_ptr<Model> model_of(const std::vector<SubjectCycles>& subjects) {
  auto model = std::make_shared<Model>();
  model->body = captured().body;
  SpeedSpaces spaces = learn_speed_spaces(subjects, captured().body);
  model->speed_spaces = std::move(spaces.subjects);
  model->shared_speed_space = std::move(spaces.shared);
  return model;
}

const std::shared_ptr<Model>& whole_model() {
  static const std::shared_ptr<Model> model = model_of(captured().subjects);
  return model;
}

SpeedWalker walker() {
  static const auto tables = make_speed_tables(*whole_model());
  return SpeedWalker(whole_model(), tables);
}

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
      SpeedWalker walking(model, tables);
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

// A walk at a steady speed, seen from outside.
struct Seen {
  Clip clip;
  std::vector<Contact> contacts;  // by phase
  double speed = 0;               // of the root over whole cycles, m/s
};

Seen seen(SpeedWalker& walking, double frame_rate, double seconds) {
  const Body& body = captured().body;
  const JointRoles roles = body_roles(body);
  RootMotion root(body.skeleton, roles, frame_rate);
  for (int i = 0; i < 2 * frame_rate; ++i) {
    walking.advance(1 / frame_rate);
    root.advance(walking.pose());
  }
  const int frames = static_cast<int>(seconds * frame_rate);
  Seen result;
  result.clip = body_clip(body, "walked", frame_rate, frames);
  std::vector<Eigen::Quaterniond> pose(body.skeleton.joints.size());
  double before = walking.phase();
  for (int frame = 0; frame < frames; ++frame) {
    walking.advance(1 / frame_rate);
    const Eigen::Vector3d hips = root.advance(walking.pose()).cast<double>();
    std::transform(walking.pose().begin(), walking.pose().end(), pose.begin(),
                   [](const auto& rotation) { return rotation.template cast<double>(); });
    place_body(result.clip, frame, roles, pose, 0, hips);
    if (walking.phase() < before)
      result.contacts.push_back({frame, Foot::right});
    else if (before < 0.5 && walking.phase() >= 0.5)
      result.contacts.push_back({frame, Foot::left});
    before = walking.phase();
  }
  std::vector<int> right;
  for (const Contact& contact : result.contacts)
    if (contact.foot == Foot::right) right.push_back(contact.frame);
  if (right.size() < 2) return result;
  const Eigen::Vector3d way = result.clip.translation(right.back())[roles.hips] -
                              result.clip.translation(right.front())[roles.hips];
  result.speed =
      std::hypot(way.x(), way.z()) * walking.scale() * frame_rate / (right.back() - right.front());
  return result;
}

TEST(SpeedRealData, feet_travel_at_the_commanded_speed) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  std::vector<std::string> names{""};
  for (const SubjectCycles& subject : captured().subjects) names.push_back(subject.subject);
  double worst = 0;
  for (const std::string& name : names)
    for (int kmh = 1; kmh <= 10; ++kmh) {
      SpeedWalker walking = walker();
      if (!name.empty()) walking.set_subject(name);
      walking.set_speed(static_cast<float>(kmh) / 3.6f);
      walking.settle();
      const double share = seen(walking, 60, 10).speed * 3.6 / kmh;
      worst = std::max(worst, std::abs(share - 1));
      EXPECT_NEAR(share, 1, 0.01) << name << ", " << kmh << " km/h";
    }
  std::printf("travelled speed: within %.2f %% of the commanded one\n", 100 * worst);
}

TEST(SpeedRealData, cadence_by_the_feet_is_a_persons) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  std::vector<CadencePoint> points;
  for (double kmh = 3; kmh <= 6.5; kmh += 0.25) {
    SpeedWalker walking = walker();
    walking.set_speed(static_cast<float>(kmh / 3.6));
    walking.settle();
    walking.advance(1e-3);
    points.push_back({walking.speed() / walking.leg_length(), walking.frequency()});
  }
  const FrequencyLaw feet = fit_frequency_law(points);
  std::printf("law by the feet: %.3f V^%.3f\n", feet.scale, feet.power);
  EXPECT_NEAR(feet.scale, 0.75, 0.075);
  EXPECT_GE(feet.power, 0.3);
  EXPECT_LE(feet.power, 0.55);
}

TEST(SpeedRealData, the_fitted_law_is_near_an_independent_one_and_its_feet_slide) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  const FrequencyLaw law = learn_speed_spaces(captured().subjects, captured().body).law;
  std::printf("fitted law: %.4f V^%.4f\n", law.scale, law.power);
  EXPECT_NEAR(law.scale, 0.752, 0.02);
  EXPECT_NEAR(law.power, 0.408, 0.03);
  for (int kmh = 1; kmh <= 10; ++kmh) {
    SpeedWalker walking = walker();
    walking.set_speed(static_cast<float>(kmh) / 3.6f);
    std::printf("%2d km/h:", kmh);
    for (const SpeedLaw by : {SpeedLaw::fitted, SpeedLaw::inman, SpeedLaw::feet}) {
      walking.set_law(by);
      walking.settle();
      walking.advance(1e-3);
      // With the root at the commanded speed, as in G04, a foot slides by the difference during the
      // half cycle that it carries the body.
      const double slide = (walking.speed_of_feet() - walking.speed()) / walking.frequency() / 2;
      std::printf("  %.3f Hz %+5.0f mm", walking.frequency(), 1000 * slide);
      if (by == SpeedLaw::feet) {
        EXPECT_NEAR(slide, 0, 1e-5);
      }
    }
    std::printf("   (fitted, Inman, feet)\n");
  }
}

struct Soles {
  double right = 0, left = 0;  // height of the lowest point, metres
};

Soles soles_at(const Clip& clip, const WorldPoses& world, int frame) {
  const JointRoles roles = body_roles(captured().body);
  const auto lowest = [&](const Leg& leg) {
    double low = INFINITY;
    for (const int joint : {leg.foot, leg.toes}) {
      const auto at = static_cast<std::size_t>(frame) * clip.skeleton.joints.size() + joint;
      low = std::min(low, world.positions[at].y());
      for (const Eigen::Vector3d& tip : clip.skeleton.joints[joint].tips)
        low = std::min(low, (world.positions[at] + world.rotations[at] * tip).y());
    }
    return low;
  };
  return {lowest(roles.right), lowest(roles.left)};
}

TEST(SpeedRealData, both_feet_touch_for_a_while_and_none_sinks_in) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  for (const std::string name : {"", "08", "16", "35", "39"})
    for (int kmh = 1; kmh <= 10; ++kmh) {
      SpeedWalker walking = walker();
      if (!name.empty()) walking.set_subject(name);
      walking.set_speed(static_cast<float>(kmh) / 3.6f);
      walking.settle();
      const Seen walk = seen(walking, 120, 5);
      const WorldPoses world = world_poses(walk.clip);
      double lowest = 1;
      for (int frame = 0; frame < walk.clip.frames(); ++frame) {
        const Soles soles = soles_at(walk.clip, world, frame);
        lowest = std::min({lowest, soles.right, soles.left});
      }
      EXPECT_GT(lowest, -0.01) << name << ", " << kmh << " km/h";
      if (kmh > 9) continue;
      for (std::size_t i = 0; i + 1 < walk.contacts.size(); ++i) {
        int together = 0;
        for (int frame = walk.contacts[i].frame; frame < walk.contacts[i + 1].frame; ++frame) {
          const Soles soles = soles_at(walk.clip, world, frame);
          // Captured toe tips dip into the ground by so much when they push off.
          together += std::abs(soles.right - soles.left) < 0.025 ? 1 : 0;
        }
        EXPECT_GE(together, 1) << name << ", " << kmh << " km/h";  // of 120 a second
      }
    }
}

TEST(SpeedRealData, feet_slide_no_more_than_the_captured_ones) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  for (std::size_t i = 0; i < captured().subjects.size(); ++i) {
    const SubjectCycles& subject = captured().subjects[i];
    double own = 0;
    int stances = 0;
    for (const Walk& walk : captured().walks) {
      if (walk.subject != subject.subject) continue;
      const JointRoles roles = find_roles(walk.clip.skeleton);
      for (const double slide :
           foot_slide(walk.clip, roles, follow_walk(walk.clip, roles).contacts).stances)
        own += slide, ++stances;
    }
    own /= stances;
    const SpeedSpace& space = whole_model()->speed_spaces[i];
    for (const double v :
         {0.4, space.slowest, (space.slowest + space.fastest) / 2, space.fastest}) {
      SpeedWalker walking = walker();
      walking.set_subject(subject.subject);
      walking.set_speed(static_cast<float>(v * space.leg_length));
      walking.settle();
      const Seen walk = seen(walking, 120, 6);
      EXPECT_LE(foot_slide(walk.clip, body_roles(captured().body), walk.contacts).mean, own)
          << subject.subject << " at V = " << v;
    }
  }
}

TEST(SpeedRealData, learning_and_walking_take_no_time) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  const std::clock_t begin = std::clock();
  const Body body = body_of_subjects(captured().walks);
  learn_speed_spaces(cycles_of_subjects(captured().walks, body), body);
  const double learning = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;

  std::vector<SpeedWalker> walkers(100, walker());
  std::vector<RootMotion> roots(100, RootMotion(body.skeleton, body_roles(body), 60));
  const std::clock_t start = std::clock();
  for (int frame = 0; frame < 120; ++frame)
    for (std::size_t i = 0; i < walkers.size(); ++i) {
      if (frame == 0) walkers[i].set_speed(0.02f * static_cast<float>(i));
      walkers[i].advance(1.0 / 60);
      roots[i].advance(walkers[i].pose());
    }
  const double core = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / 2;

  SpeedWalker one = walker();
  one.set_speed(1.4f);
  std::vector<double> microseconds;
  for (int frame = 0; frame < 5000; ++frame) {
    const auto before = std::chrono::steady_clock::now();
    one.advance(1.0 / 60);
    const std::chrono::duration<double, std::micro> took =
        std::chrono::steady_clock::now() - before;
    microseconds.push_back(took.count());
  }
  std::sort(microseconds.begin(), microseconds.end());
  const double median = microseconds[microseconds.size() / 2];
  std::printf("learning %.2f s; a frame %.2f us; 100 walkers with roots %.3f of a core\n", learning,
              median, core);
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(learning, 2);
  EXPECT_LT(median, 5);
  EXPECT_LT(core, 0.2);
#endif
}

}  // namespace
}  // namespace gait
