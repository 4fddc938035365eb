// Synthetic walks of two people at several speeds, and a model of them that the speed walker can
// walk as.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gait/corpus/synthetic_walk.h"
#include "gait/learn/speed_space.h"
#include "gait/model/body_pose.h"

namespace gait::testing {

// `speed_per_leg`: V. 60 frames a second, contacts left to be found.
inline Walk walk_at(double speed_per_leg, double leg_length, const std::string& subject,
                    int take = 1) {
  WalkPlan plan;
  plan.style.speed = speed_per_leg;
  plan.leg_length = leg_length;
  plan.take = take;
  const SyntheticWalk drawn(plan);
  Walk walk;
  walk.subject = subject;
  walk.clip.name = subject + "_" + std::to_string(speed_per_leg);
  walk.clip.skeleton = drawn.skeleton();
  walk.clip.frame_rate = 60;
  walk.clip.resize(static_cast<int>(drawn.duration() * walk.clip.frame_rate));
  const int hips = find_roles(walk.clip.skeleton).hips;
  for (int frame = 0; frame < walk.clip.frames(); ++frame)
    walk.clip.translation(frame)[hips] =
        drawn.pose(frame / walk.clip.frame_rate, walk.clip.pose(frame));
  return walk;
}

constexpr double tall_leg = 0.92, short_leg = 0.76;

inline std::vector<Walk> walks_over_speed() {
  std::vector<Walk> walks;
  for (const double speed : {1.1, 1.4, 1.7, 2.0}) {
    walks.push_back(walk_at(speed, tall_leg, "tall", 1));
    walks.push_back(walk_at(speed + 0.1, short_leg, "short", 2));
  }
  return walks;
}

inline std::shared_ptr<Model> speed_model(const std::vector<Walk>& walks,
                                          const SpeedOptions& options = {}) {
  auto model = std::make_shared<Model>();
  model->name = "walks over speed";
  model->body = body_of_subjects(walks, options.roles);
  SpeedSpaces spaces =
      learn_speed_spaces(cycles_of_subjects(walks, *model->body, options), *model->body, options);
  model->speed_spaces = std::move(spaces.subjects);
  model->shared_speed_space = std::move(spaces.shared);
  return model;
}

// Learnt once a program.
inline std::shared_ptr<const Model> speed_model() {
  static const std::shared_ptr<const Model> model = speed_model(walks_over_speed());
  return model;
}

}  // namespace gait::testing
