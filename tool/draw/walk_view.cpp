#include "draw/walk_view.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "gait/motion/contacts.h"
#include "gait/motion/heading.h"
#include "gait/motion/kinematics.h"
#include "gait/platform/path_text.h"

namespace gait::tool {

namespace {

std::vector<Eigen::Vector3d> world_points(const StickBones& figure, const WorldPoses& world,
                                          int frames, int joints) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(static_cast<std::size_t>(frames) * figure.points.size());
  for (int frame = 0; frame < frames; ++frame)
    for (const Point& point : figure.points) {
      const std::size_t joint = static_cast<std::size_t>(frame) * joints + point.joint;
      points.emplace_back(world.positions[joint] + world.rotations[joint] * point.offset);
    }
  return points;
}

// The walker's own place: the hips, or the middle of what is drawn.
std::vector<Eigen::Vector3d> centres(const StickBones& figure, const JointRoles& roles,
                                     const std::vector<Eigen::Vector3d>& points, int frames) {
  std::vector<Eigen::Vector3d> centre(frames, Eigen::Vector3d::Zero());
  const std::size_t count = figure.points.size();
  for (int frame = 0; frame < frames; ++frame) {
    const Eigen::Vector3d* pose = points.data() + static_cast<std::size_t>(frame) * count;
    if (roles.hips >= 0) {
      centre[frame] = pose[roles.hips];
      continue;
    }
    int drawn = 0;
    for (std::size_t point = 0; point < count; ++point)
      if (figure.drawn[point]) centre[frame] += pose[point], ++drawn;
    centre[frame] /= std::max(1, drawn);
  }
  return centre;
}

// From the head to the farthest joint that is not above the hips (empty roots lie anywhere).
double reach_from_head(const Clip& clip, const JointRoles& roles, const WorldPoses& world) {
  const int head = roles.joint(Role::head);
  if (head < 0 || world.positions.empty()) return 0;
  double reach = 0;
  for (int joint = roles.hips < 0 ? 0 : roles.hips; joint < clip.skeleton.size(); ++joint)
    reach = std::max(reach, (world.positions[joint] - world.positions[head]).norm());
  return reach;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void Extent::include(const WalkView& view, int frame, double half_limb) {
  for (std::size_t i = 0; i < view.figure.points.size(); ++i) {
    if (!view.figure.drawn[i]) continue;
    const bool head = static_cast<int>(i) == view.figure.head_centre;
    const double radius = head ? view.figure.head_radius : half_limb;
    const Eigen::Vector3d& point = view.point(frame, static_cast<int>(i));
    left = std::min(left, point.x() - radius);
    right = std::max(right, point.x() + radius);
    low = std::min(low, point.y() - radius);
    high = std::max(high, point.y() + radius);
  }
}

WalkView view_walk(const Clip& clip, const JointRoles& roles, double degrees) {
  WalkView view;
  view.name = utf8_of(path_from_utf8(clip.name).stem());
  view.frame_rate = clip.frame_rate;
  view.frames = clip.frames();
  view.in_metres = roles.has_legs();

  // Without legs nothing says where it faces: the camera then stands by the file's axes.
  std::vector<double> heading(view.frames, 0.0);
  std::vector<Contact> contacts;
  WorldPoses world;
  if (roles.has_legs()) {
    WalkTrack track = follow_walk(clip, roles);
    heading = std::move(track.heading);
    contacts = std::move(track.contacts);
    world = std::move(track.world);
  } else {
    world = world_poses(clip);
  }
  view.figure = stick_bones(clip.skeleton, roles, reach_from_head(clip, roles, world));
  view.points = world_points(view.figure, world, view.frames, clip.skeleton.size());
  const std::vector<Eigen::Vector3d> centre = centres(view.figure, roles, view.points, view.frames);

  const double angle = degrees * std::numbers::pi / 180;
  view.foreshortening = std::abs(std::sin(angle));
  const std::size_t count = view.figure.points.size();
  std::vector<double> lowest(view.frames), height(view.frames);
  view.travel.assign(view.frames, 0.0);
  for (int frame = 0; frame < view.frames; ++frame) {
    const Eigen::Vector3d forward = heading_direction(heading[frame]);
    const Eigen::Vector3d left(forward.z(), 0, -forward.x());  // facing +Z, +X is on the left
    const Eigen::Vector3d right_in_picture = std::sin(angle) * forward + std::cos(angle) * left;
    const Eigen::Vector3d to_viewer = std::cos(angle) * forward - std::sin(angle) * left;
    if (frame > 0)
      view.travel[frame] = view.travel[frame - 1] +
                           std::sin(angle) * (centre[frame] - centre[frame - 1]).dot(forward);
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Vector3d& point = view.points[static_cast<std::size_t>(frame) * count + i];
      const Eigen::Vector3d from_centre = point - centre[frame];
      point = {from_centre.dot(right_in_picture), point.y(), from_centre.dot(to_viewer)};
      if (!view.figure.drawn[i]) continue;
      low = std::min(low, point.y());
      high = std::max(high, point.y());
    }
    lowest[frame] = low;
    height[frame] = high - low;
  }

  // The ground: low, but not the one frame in twenty in which a marker slipped.
  if (view.frames > 0) {
    std::vector<double> sorted = lowest;
    std::sort(sorted.begin(), sorted.end());
    const double ground = sorted[sorted.size() / 20];
    for (Eigen::Vector3d& point : view.points) point.y() -= ground;
    view.height = std::max(1e-6, median(height));
  }
  for (const Contact& contact : contacts) {
    const int foot = contact.foot == Foot::right ? roles.right.foot : roles.left.foot;
    view.footprints.push_back({contact.frame, contact.foot,
                               view.travel[contact.frame] + view.point(contact.frame, foot).x()});
  }
  return view;
}

}  // namespace gait::tool
