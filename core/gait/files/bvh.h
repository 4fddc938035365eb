// BVH files: the content of a file as it is written (BvhFile), and the motion that it describes
// (Clip).
//
// With both, a program can change some joints and write the rest untouched: hierarchy, channel
// orders and values that were not set are written as they were read.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gait/alignment.h"
#include "gait/motion/clip.h"

namespace gait {

enum class Channel : std::uint8_t {
  x_position,
  y_position,
  z_position,
  x_rotation,
  y_rotation,
  z_rotation
};
// As files name them, in that order.
inline constexpr std::array<std::string_view, 6> channel_names{
    "Xposition", "Yposition", "Zposition", "Xrotation", "Yrotation", "Zrotation"};

struct BvhFile {
  std::string name;                            // path, for messages
  Skeleton skeleton;                           // in the file's own unit and axes
  std::vector<std::vector<Channel>> channels;  // per joint, in the file's order
  double frame_time = 1.0 / 30;                // seconds
  // One row per frame, one column per channel; rotations in degrees as in the file.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values;
  std::vector<std::string> warnings;  // odd but usable content, each with file and line
};

// Reads a BVH file. Throws Error with file, line and what was expected: not a BVH, no whole row, a
// wrong number of values in a row, NaN or Inf, unknown channels, absurd counts (above 10000 joints,
// 32 channels a joint, numbers of 1e9, 1 GiB), nesting deeper than 200. More or fewer rows than
// announced are a warning, and all are used; so is a last row that breaks off, which is left out.
// Names of joints may hold spaces and occur twice; there may be several roots.
BvhFile read_bvh(const std::filesystem::path& path);
BvhFile parse_bvh(std::string_view text, std::string name);

// Writes a file with the same hierarchy and channel orders, and values that read back as the same
// doubles. The file appears whole or not at all. Throws Error when it cannot be written.
void write_bvh(const BvhFile& file, const std::filesystem::path& path);
std::string bvh_text(const BvhFile& file);

// The motion of a file, in the file's unit and axes. Position channels replace the joint's offset,
// each for its axis; rotations apply in the order of the channels, however many there are. A frame
// time within 1e-4 of a whole frame rate is taken as that rate (0.0333333 s: 30 frames per second).
Clip clip_from_bvh(const BvhFile& file);

// Whether the joint's rotation channels can express any rotation: three, no axis twice in a row.
bool takes_rotation(const BvhFile& file, int joint);

// Set a local rotation (or translation, in the file's unit) in a frame's channels, in the joint's
// own channel order. Euler angles (kept to a microdegree) are chosen nearest to those of
// the frame before, and nearest to zero in frame 0, so that curves do not jump: set frames in
// order. Throws Error naming the joint when it does not take a rotation; a position channel that
// the joint lacks is ignored.
void set_rotation(BvhFile& file, int frame, int joint, const Eigen::Quaterniond& rotation);
void set_translation(BvhFile& file, int frame, int joint, const Eigen::Vector3d& translation);

// A file for a clip that came from none: roots, and joints that move against their offset, get six
// channels (positions, then Z, X, Y rotations), other joints three.
BvhFile bvh_from_clip(const Clip& clip);

}  // namespace gait
