// Input stream: frames as a sender sends them, at its own times, into frames at the model's rate.
//
// A frame is model.input.values numbers, stream after stream: the rotation vector of a joint
// relative to its reference (radians; the hips' with heading out), or plain values. Rotations are
// resampled by SLERP, plain values linearly (frame_clock.h). A frame may also be put together from
// single streams, given as rotation vectors, as quaternions or as Euler angles, or be picked out of
// a whole body. A missing stream is held as it was, and not looked at. Times in seconds. Nothing
// allocates after construction.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "gait/model/stream_layout.h"
#include "gait/play/input/frame_clock.h"
#include "gait/play/input/hips_heading.h"

namespace gait {

class InputStream {
 public:
  // `longest_gap`: a longer silence is not bridged, seconds. Throws Error as FrameClock does.
  explicit InputStream(std::shared_ptr<const Model> model, double longest_gap = 1.0);

  // Takes a frame. Then pull with next() until it says false. Rejected, with nothing changed, when
  // its time is not after the frame before, its size is another or a number of a stream that is
  // there is not finite.
  FrameClock::Arrival push(double time, std::span<const float> values) noexcept;
  // The same with a whole body: three numbers per joint of the body, in its order. Rejected by
  // models without one.
  FrameClock::Arrival push_body(double time, std::span<const float> pose) noexcept;
  // The same with the streams set one by one; those that were not set are as before.
  FrameClock::Arrival push_collected(double time) noexcept;

  // Set one stream of the frame to come. False, with nothing changed, when there is no such stream,
  // it is of another kind or size, or a number is not finite. Local rotations; of the hips' world
  // rotation the heading is taken out.
  bool set_values(int stream, std::span<const float> values) noexcept;
  bool set_rotation(int stream,
                    const Eigen::Quaternionf& rotation) noexcept;  // of any length but 0
  // `order`: three of X, Y and Z, such as ZXY, applied left to right as a BVH file's channels are:
  // R = R_Z(a) R_X(b) R_Y(c). Degrees.
  bool set_euler(int stream, std::string_view order, std::span<const float, 3> degrees) noexcept;

  void set_missing(int stream, bool missing) noexcept { missing_[stream] = missing; }
  bool missing(int stream) const noexcept { return missing_[stream]; }

  // Makes the next frame that is due and says true; false when none is.
  bool next() noexcept;
  std::span<const float> values() const noexcept { return resampled_; }
  // The heading that was taken out of that frame's hips (radians); none unless they came turned in
  // the world.
  std::optional<float> heading() const noexcept { return heading_out_; }
  double time() const noexcept { return clock_.time(); }
  // That frame is the first after a start or a jump of time: none before it belongs to its motion.
  bool first_of_run() const noexcept { return clock_.first_of_run(); }
  // How long that frame waited for the one that was pushed last, by the sender's clock.
  double waited() const noexcept { return pushed_ - clock_.time(); }

  int streams() const noexcept { return layout_.streams(); }
  int first_value(int stream) const noexcept { return layout_[stream].begin; }
  void reset() noexcept;

 private:
  struct Frame {
    std::vector<Eigen::Quaternionf> rotations;  // relative to the references, stream by stream
    std::vector<float> plain;
  };

  void collect(int stream, const float* values) noexcept;

  std::shared_ptr<const Model> model_;
  StreamLayout layout_;
  std::vector<int> index_;  // of a stream's rotation, or of its first plain value, in a Frame
  std::vector<Eigen::Quaternionf> references_;  // per joint of the body
  FrameClock clock_;
  std::optional<HipsHeading> heading_;
  int hips_ = -1;            // stream of the hips, -1: not measured
  bool hips_world_ = false;  // they come with their heading
  std::vector<bool> missing_;
  Frame collected_, usable_, due_;
  std::vector<float> resampled_;
  std::optional<float> heading_out_;
  double pushed_ = 0;
};

// The quaternion of Euler angles (degrees) in an order such as ZXY; none when the order is not
// three axes, neighbours different, or an angle is not finite.
std::optional<Eigen::Quaternionf> rotation_from_euler(std::string_view order,
                                                      std::span<const float, 3> degrees) noexcept;

}  // namespace gait
