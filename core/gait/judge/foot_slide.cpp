#include "gait/judge/foot_slide.h"

#include <numeric>
#include <string>

#include "gait/error.h"
#include "gait/motion/kinematics.h"

namespace gait {
namespace {

struct SolePoint {
  int joint;
  Eigen::Vector3d offset;  // in the joint's frame
};

std::vector<SolePoint> sole_points(const Skeleton& skeleton, int foot) {
  std::vector<SolePoint> points;
  for (int joint = foot; joint < skeleton.size(); ++joint) {
    if (!skeleton.is_in_branch(joint, foot)) continue;
    points.push_back({joint, Eigen::Vector3d::Zero()});
    for (const Eigen::Vector3d& tip : skeleton.joints[joint].tips) points.push_back({joint, tip});
  }
  return points;
}

double travel_of_lowest(const std::vector<SolePoint>& points, const Step& step,
                        const WorldPoses& world, int joints) {
  const auto place = [&](int frame, const SolePoint& point) -> Eigen::Vector3d {
    const std::size_t at = static_cast<std::size_t>(frame) * joints + point.joint;
    return world.positions[at] + world.rotations[at] * point.offset;
  };
  double travel = 0;
  std::size_t lowest_before = points.size();
  for (int frame = step.begin; frame < step.end; ++frame) {
    std::size_t lowest = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (place(frame, points[i]).y() < place(frame, points[lowest]).y()) lowest = i;
    if (lowest == lowest_before) {
      Eigen::Vector3d moved = place(frame, points[lowest]) - place(frame - 1, points[lowest]);
      moved.y() = 0;
      travel += moved.norm();
    }
    lowest_before = lowest;
  }
  return travel;
}

}  // namespace

FootSlide foot_slide(const Clip& clip, const JointRoles& roles,
                     const std::vector<Contact>& contacts) {
  for (const Leg* leg : {&roles.right, &roles.left})
    if (leg->foot < 0 || leg->foot >= clip.skeleton.size())
      throw Error(clip.name + ": foot slide needs a joint with the role of each foot; found none");
  for (const Contact& contact : contacts)
    if (contact.frame < 0 || contact.frame >= clip.frames())
      throw Error(clip.name + ": expected contacts within its " + std::to_string(clip.frames()) +
                  " frames, found one at frame " + std::to_string(contact.frame));

  const WorldPoses world = world_poses(clip);
  const auto right = sole_points(clip.skeleton, roles.right.foot);
  const auto left = sole_points(clip.skeleton, roles.left.foot);
  FootSlide slide;
  for (const Step& step : steps_between(contacts))
    slide.stances.push_back(1000 * travel_of_lowest(step.foot == Foot::right ? right : left, step,
                                                    world, clip.skeleton.size()));
  if (!slide.stances.empty())
    slide.mean = std::accumulate(slide.stances.begin(), slide.stances.end(), 0.0) /
                 static_cast<double>(slide.stances.size());
  return slide;
}

}  // namespace gait
