// A clip as a camera sees it that goes beside the walker, always at the same angle to the heading.
//
// A walk that turns is seen unrolled: the way walked lies along the picture.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "draw/stick_bones.h"
#include "gait/motion/clip.h"
#include "gait/motion/steps.h"

namespace gait::tool {

// Where a foot first touches.
struct Footprint {
  int frame = 0;
  Foot foot = Foot::right;
  double right = 0;  // metres along the picture
};

struct WalkView {
  std::string name;  // for titles: the file's name without folder and ending
  double frame_rate = 30;
  int frames = 0;
  bool in_metres = false;  // legs are known, so the unit is
  StickBones figure;

  // Frame after frame, one entry per point of `figure`, metres: right in the picture from the
  // walker's own place, up from the ground, towards the viewer.
  std::vector<Eigen::Vector3d> points;
  std::vector<double> travel;  // per frame: the walker's place along the picture (metres)
  double foreshortening = 1;   // metres along the picture per metre walked: 1 from the side
  std::vector<Footprint> footprints;
  double height = 1;  // metres from the lowest to the highest point, over frames the median

  const Eigen::Vector3d& point(int frame, int index) const {
    return points[static_cast<std::size_t>(frame) * figure.points.size() + index];
  }
  double seconds() const { return frames < 2 ? 0 : (frames - 1) / frame_rate; }
};

// What figures reach, metres, about the walker's own place on the ground.
struct Extent {
  double left = std::numeric_limits<double>::max();
  double right = std::numeric_limits<double>::lowest();
  double low = 0, high = 0;

  // Widens it to one frame's figure, whose limbs are `half_limb` thick on either side.
  void include(const WalkView& view, int frame, double half_limb);
};

// `clip`: metres, Y up. `degrees`: where the camera stands around the walker, 0 in front of the
// face, 90 at the right side (who then walks from left to right), 180 behind.
WalkView view_walk(const Clip& clip, const JointRoles& roles, double degrees);

}  // namespace gait::tool
