// Pose recorder: frames of a model's body as they come, kept to be played again.
//
// A frame comes as a whole pose, or as inputs and outputs; the place of the hips comes by itself. A
// pose or outputs complete a frame, inputs alone only when the next inputs follow. What does not
// come with a frame stays as it was.
//
// Frames are kept in blocks of half a minute, up to an hour, and are never moved. While a block is
// filled, a thread of the recorder's makes the next one: taking frames allocates nothing, unless
// half a minute of frames comes faster than a block is made. finish and clear allocate and free:
// they are a user's commands, not the frame's.
//
// Units: metres, seconds, radians; values are rotation vectors relative to the model's references.
#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gait/joining_thread.h"
#include "gait/model/body_motion.h"
#include "gait/model/model.h"

namespace gait {

class PoseRecorder {
 public:
  static constexpr double longest_seconds = 3600;  // at the model's rate

  // What was recorded, to be made a walk of away from the show.
  class Recording;

  // Throws Error when the model has no body.
  explicit PoseRecorder(std::shared_ptr<const Model> model);

  // Each says false, and keeps nothing, when there are not as many values as the model wants, one
  // is not finite, or the recorder is full. `time`: when it came, seconds on any clock.
  bool take_pose(std::span<const float> values, double time) noexcept;
  bool take_outputs(std::span<const float> values, double time) noexcept;
  bool take_inputs(std::span<const float> values, double time) noexcept;
  bool take_root(const Eigen::Vector3f& hips, float heading) noexcept;

  int frames() const noexcept { return frames_; }
  bool full() const noexcept { return frames_ >= most_frames_; }
  // Whether the block that comes next has been made.
  bool prepared() const noexcept { return maker_.made(); }

  // Hands over all frames and begins anew.
  Recording finish();
  void clear();

 private:
  struct Block {
    Block() = default;
    Block(std::size_t frames, std::size_t joints)
        : rotations(frames * joints), hips(frames), heading(frames) {}

    std::vector<Eigen::Quaternionf> rotations;
    std::vector<Eigen::Vector3f> hips;
    std::vector<float> heading;
  };

  // Makes one block ahead on a thread of its own.
  class BlockMaker {
   public:
    BlockMaker(int frames, std::size_t joints);
    ~BlockMaker();

    bool made() const noexcept { return state_.load(std::memory_order_acquire) == State::made; }
    // The block; the thread makes another one. While it has none, the caller makes the block.
    Block take();

   private:
    enum class State { wanted, made, closing };

    void work();

    std::size_t frames_, joints_;
    Block block_;  // of the thread while it is wanted, of take once it is made
    std::atomic<State> state_{State::wanted};
    JoiningThread worker_;
  };

  bool take(std::span<const float> values, std::span<const int> joints) noexcept;
  void keep(double time) noexcept;

  std::shared_ptr<const Model> model_;
  std::vector<Eigen::Quaternionf> references_;
  std::vector<int> all_joints_;
  int block_frames_, most_frames_;
  BlockMaker maker_;
  std::vector<Block> blocks_;
  int frames_ = 0;
  double first_time_ = 0, last_time_ = 0, inputs_time_ = 0;
  bool inputs_wait_ = false;  // inputs came that no outputs or pose have followed
  bool root_told_ = false;
  std::vector<Eigen::Quaternionf> pose_;  // of the frame that is recorded next
  Eigen::Vector3f hips_ = Eigen::Vector3f::Zero();
  float heading_ = 0;
};

class PoseRecorder::Recording {
 public:
  int frames() const { return frames_; }
  // The recorded walk, with its contacts and steps. Its rate is the rate at which frames came; it
  // is the model's where the two differ by less than a twentieth or where times say nothing.
  // Without recorded roots the feet carry the hips. It takes long: call it on a worker.
  BodyMotion motion(const std::string& name) const;

 private:
  friend class PoseRecorder;
  double frame_rate() const;

  std::shared_ptr<const Model> model_;
  std::vector<Block> blocks_;
  int block_frames_ = 1, frames_ = 0;
  double seconds_ = 0;  // from the first frame to the last
  bool root_told_ = false;
};

}  // namespace gait
