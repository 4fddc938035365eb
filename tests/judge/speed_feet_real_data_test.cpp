// The speed walker's feet against captured ones (G04 §5, §6): they tell the truth, nobody floats,
// and it takes no time.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "gait/judge/foot_slide.h"
#include "gait/learn/speed_space.h"
#include "gait/model/body_pose.h"
#include "gait/motion/contacts.h"
#include "gait/motion/kinematics.h"
#include "gait/offline/walk_recorder.h"
#include "gait/play/body/foot_lock.h"
#include "judge/captured_speeds.h"
#include "play/body/bends.h"
#include "shared_data.h"

namespace gait {
namespace {

using testing::captured;
using testing::walker;
using testing::whole_model;

// A walk at a steady speed, seen from outside.
struct Seen {
  Clip clip;
  std::vector<Contact> contacts;  // by phase
  double speed = 0;               // of the root over whole cycles, m/s
};

Seen seen(SpeedWalker& walking, double frame_rate, double seconds) {
  const Body& body = captured().body;
  const JointRoles roles = body_roles(body);
  WalkRecorder recorder(body, frame_rate);
  for (int i = 0; i < 2 * frame_rate; ++i) {
    walking.advance(1 / frame_rate);
    recorder.lead_in(walking.pose());
  }
  const int frames = static_cast<int>(seconds * frame_rate);
  Seen result;
  double before = walking.phase();
  for (int frame = 0; frame < frames; ++frame) {
    walking.advance(1 / frame_rate);
    recorder.add(walking.pose());
    if (walking.phase() < before)
      result.contacts.push_back({frame, Foot::right});
    else if (before < 0.5 && walking.phase() >= 0.5)
      result.contacts.push_back({frame, Foot::left});
    before = walking.phase();
  }
  result.clip = recorder.clip("walked");
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

TEST(SpeedFeetRealData, feet_travel_at_the_commanded_speed) {
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

TEST(SpeedFeetRealData, cadence_by_the_feet_is_a_persons) {
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

TEST(SpeedFeetRealData, the_fitted_law_is_near_an_independent_one_and_its_feet_slide) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  const FrequencyLaw law = learn_speed_spaces(captured().subjects, captured().body).law;
  std::printf("fitted law: %.4f V^%.4f\n", law.scale, law.power);
  EXPECT_NEAR(law.scale, 0.752, 0.02);
  EXPECT_NEAR(law.power, 0.408, 0.03);
  for (int kmh = 1; kmh <= 10; ++kmh) {
    SpeedWalker walking = walker();
    walking.set_speed(static_cast<float>(kmh) / 3.6f);
    std::printf("%2d km/h:", kmh);
    walking.set_law(SpeedLaw::feet);
    walking.settle();
    walking.advance(1e-3);
    const double of_feet = walking.frequency();
    for (const SpeedLaw by : {SpeedLaw::fitted, SpeedLaw::inman, SpeedLaw::feet}) {
      walking.set_law(by);
      walking.settle();
      walking.advance(1e-3);
      // With the root at the commanded speed, as in G04, a foot slides by the difference during the
      // half cycle that it carries the body.
      const double slide = walking.speed() * (1 / of_feet - 1 / walking.frequency()) / 2;
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

// Captured soles roll: while one heel comes down the other foot stands on its toes.
constexpr double touching = 0.025;  // m above the ground
// Of a cycle. Walkers touch with both feet for 0.2 to 0.3 of it at usual speeds, and for less and
// less as they near running.
constexpr double least_together = 0.04;

// The least share of any cycle during which both soles touch.
double shortest_together(const Seen& walk, const WorldPoses& world) {
  double least = 1;
  for (std::size_t i = 0; i + 2 < walk.contacts.size(); ++i) {
    int together = 0;
    const int begin = walk.contacts[i].frame, end = walk.contacts[i + 2].frame;
    for (int frame = begin; frame < end; ++frame) {
      const Soles soles = soles_at(walk.clip, world, frame);
      together += soles.right < touching && soles.left < touching;
    }
    least = std::min(least, static_cast<double>(together) / (end - begin));
  }
  return least;
}

TEST(SpeedFeetRealData, both_feet_touch_for_a_while_and_none_sinks_in) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  std::vector<std::string> names{""};
  for (const SubjectCycles& subject : captured().subjects) names.push_back(subject.subject);
  for (int kmh = 1; kmh <= 10; ++kmh) {
    double least = 1, most = 0, knees = 9;
    for (const std::string& name : names) {
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
      testing::BendRange bends;
      bends.see(walk.clip, captured().body.roles);
      knees = std::min({knees, bends.least[0], bends.least[1]});
      const double share = shortest_together(walk, world);
      least = std::min(least, share), most = std::max(most, share);
      if (kmh <= 9) {
        EXPECT_GE(share, least_together) << name << ", " << kmh << " km/h";
      }
    }
    std::printf(
        "%2d km/h: both feet touch for %.2f to %.2f of the cycle, knees bend %.1f degrees or "
        "more\n",
        kmh, least, most, knees * 180 / M_PI);
    EXPECT_GE(knees, -0.01) << kmh;  // they never bend the wrong way
  }
}

TEST(SpeedFeetRealData, feet_slide_no_more_than_the_captured_ones) {
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
    // Beyond the fastest walk that was captured, up to 10 km/h, feet land at 2 m/s.
    const double fastest = highest_speed / space.leg_length;
    double most = 0, beyond = 0;
    for (const double v : {0.4, space.slowest, (space.slowest + space.fastest) / 2, space.fastest,
                           (space.fastest + fastest) / 2, fastest}) {
      SpeedWalker walking = walker();
      walking.set_subject(subject.subject);
      walking.set_speed(static_cast<float>(v * space.leg_length));
      walking.settle();
      const Seen walk = seen(walking, 120, 6);
      const double slide = foot_slide(walk.clip, body_roles(captured().body), walk.contacts).mean;
      (v > space.fastest ? beyond : most) = std::max(v > space.fastest ? beyond : most, slide);
      EXPECT_LE(slide, own) << subject.subject << " at V = " << v;
    }
    std::printf("%s: %.0f mm a stance at most, %.0f beyond the fastest walk, captured %.0f\n",
                subject.subject.c_str(), most, beyond, own);
  }
}

TEST(SpeedFeetRealData, learning_and_walking_take_no_time) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  const std::clock_t begin = std::clock();
  const Body body = body_of_subjects(captured().walks);
  learn_speed_spaces(cycles_of_subjects(captured().walks, body), body);
  const double learning = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;

  std::vector<SpeedWalker> walkers(100, walker());
  std::vector<RootMotion> roots(100, RootMotion(body.skeleton, body_roles(body), 60));
  std::vector<FootLock> locks(100, FootLock(body.skeleton, body_roles(body), 60));
  std::vector<Eigen::Quaternionf> pose(body.skeleton.joints.size());
  const std::clock_t start = std::clock();
  for (int frame = 0; frame < 120; ++frame)
    for (std::size_t i = 0; i < walkers.size(); ++i) {
      if (frame == 0) walkers[i].set_speed(0.02f * static_cast<float>(i));
      walkers[i].advance(1.0 / 60);
      roots[i].advance(walkers[i].pose());
      std::ranges::copy(walkers[i].pose(), pose.begin());
      locks[i].apply(pose, roots[i]);
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
  std::printf("learning %.2f s; a frame %.2f us; 100 walkers on the ground %.3f of a core\n",
              learning, median, core);
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(learning, 2);
  EXPECT_LT(median, 5);
  EXPECT_LT(core, 0.2);
#endif
}

}  // namespace
}  // namespace gait
