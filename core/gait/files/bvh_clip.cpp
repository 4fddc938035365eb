#include <cmath>
#include <numbers>

#include "gait/files/bvh.h"

namespace gait {
namespace {

// rotation * (rotation by `degrees` about axis I); J and K are the axes after it.
template <int I>
void turn_about(Eigen::Quaterniond& rotation, double degrees) {
  constexpr int J = (I + 1) % 3, K = (I + 2) % 3, W = 3;
  const double half = degrees * std::numbers::pi / 360;
  const double c = std::cos(half), s = std::sin(half);
  const Eigen::Vector4d q = rotation.coeffs();
  rotation.coeffs()[W] = q[W] * c - q[I] * s;
  rotation.coeffs()[I] = q[W] * s + q[I] * c;
  rotation.coeffs()[J] = q[J] * c + q[K] * s;
  rotation.coeffs()[K] = q[K] * c - q[J] * s;
}

// Files round the frame time (0.0333333 s): within 1e-4 of a whole number of frames a second, that
// number is meant. 29.97 and 23.976 are ten times farther away.
double frame_rate_meant(double frame_time) {
  const double rate = 1 / frame_time;
  const double whole = std::round(rate);
  return whole >= 1 && std::abs(rate - whole) < 1e-4 * whole ? whole : rate;
}

bool keeps_its_offset(const Clip& clip, int joint) {
  const Eigen::Vector3d& offset = clip.skeleton.joints[joint].offset;
  for (int frame = 0; frame < clip.frames(); ++frame)
    if (clip.translation(frame)[joint] != offset) return false;
  return true;
}

}  // namespace

Clip clip_from_bvh(const BvhFile& file) {
  Clip clip;
  clip.name = file.name;
  clip.skeleton = file.skeleton;
  clip.frame_rate = frame_rate_meant(file.frame_time);
  clip.resize(static_cast<int>(file.values.rows()));
  for (int frame = 0; frame < clip.frames(); ++frame) {
    const auto rotations = clip.pose(frame);
    const auto translations = clip.translation(frame);
    Eigen::Index column = 0;
    for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
      Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
      for (const Channel channel : file.channels[joint]) {
        const double value = file.values(frame, column++);
        const int axis = static_cast<int>(channel) % 3;
        if (channel <= Channel::z_position)
          translations[joint][axis] = value;
        else if (axis == 0)
          turn_about<0>(rotation, value);
        else if (axis == 1)
          turn_about<1>(rotation, value);
        else
          turn_about<2>(rotation, value);
      }
      rotations[joint] = rotation.normalized();
    }
  }
  return clip;
}

BvhFile bvh_from_clip(const Clip& clip) {
  using enum Channel;
  BvhFile file;
  file.name = clip.name;
  file.skeleton = clip.skeleton;
  file.frame_time = 1 / clip.frame_rate;
  Eigen::Index columns = 0;
  for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
    if (clip.skeleton.joints[joint].parent < 0 || !keeps_its_offset(clip, joint))
      file.channels.push_back(
          {x_position, y_position, z_position, z_rotation, x_rotation, y_rotation});
    else
      file.channels.push_back({z_rotation, x_rotation, y_rotation});
    columns += static_cast<Eigen::Index>(file.channels.back().size());
  }
  file.values.setZero(clip.frames(), columns);
  for (int frame = 0; frame < clip.frames(); ++frame)
    for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
      set_rotation(file, frame, joint, clip.pose(frame)[joint]);
      set_translation(file, frame, joint, clip.translation(frame)[joint]);
    }
  return file;
}

}  // namespace gait
