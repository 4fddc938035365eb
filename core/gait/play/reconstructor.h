// Reconstructor (T14 §4): (time, input pose) in, decision and full pose out, with no delay unless
// the settings ask for one.
//
// It joins the resampling clock, the player and the root's motion. Poses may come at any rate and
// any joint may go missing and come back; frames leave at the model's rate.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "gait/play/body/root_motion.h"
#include "gait/play/input/frame_clock.h"
#include "gait/play/input/hips_heading.h"
#include "gait/play/player.h"

namespace gait {

struct ReconstructedFrame {
  double time = 0;  // of the input frame it belongs to, by the sender's clock
  Decision decision;
  std::span<const float> styles;   // posteriors, one per style
  std::span<const float> outputs;  // model.output.values values
  // One per joint of the body: local rotations, the hips' in the world with heading out.
  std::span<const Eigen::Quaternionf> pose;
  float heading = 0;                               // radians; 0 unless the hips are an input
  Eigen::Vector3f hips = Eigen::Vector3f::Zero();  // metres, from the feet alone
};

class Reconstructor {
 public:
  // The model must have a body; throws Error when it has none or cannot be played.
  explicit Reconstructor(std::shared_ptr<const Model> model, const PlayerSettings& settings = {});

  // Takes a pose with its time in seconds: local rotations of the model's input joints, in the
  // order of its inputs (the hips', if they are one, in the world). Then call next() until it says
  // false.
  FrameClock::Arrival push(double time, std::span<const Eigen::Quaternionf> inputs) noexcept;

  // Makes the next frame that is due; `frame` speaks of it until the next call.
  bool next() noexcept;
  // After the last pose: what delays still hold back.
  bool flush() noexcept;
  const ReconstructedFrame& frame() const noexcept { return frame_; }

  // `input`: index into the model's inputs. A missing joint's rotation is not looked at.
  void set_missing(int input, bool missing) noexcept;

  Player& player() noexcept { return player_; }
  int delay() const noexcept { return player_.delay(); }  // frames
  const Model& model() const noexcept { return player_.model(); }
  void reset(const Eigen::Vector3f& place = Eigen::Vector3f::Zero()) noexcept;

 private:
  struct Taken {  // what an output frame needs of its input frame
    double time = 0;
    float heading = 0;
    std::vector<Eigen::Quaternionf> inputs;
  };

  void take() noexcept;
  void make(int i) noexcept;

  Player player_;
  FrameClock clock_;
  RootMotion root_;
  HipsHeading hips_heading_;
  std::vector<Eigen::Quaternionf> references_;
  int hips_input_;                           // index into the inputs, -1: not measured
  std::vector<Eigen::Quaternionf> arrived_;  // the frame just pulled from the clock
  std::vector<Eigen::Quaternionf> usable_;   // the same with missing joints held
  std::vector<bool> missing_;
  std::vector<Taken> ring_;
  int taken_ = 0, made_ = 0;  // frames so far
  int waiting_ = 0;           // of the player's available frames, the next to hand out
  std::vector<Eigen::Quaternionf> pose_;
  std::vector<float> values_;
  ReconstructedFrame frame_;
};

}  // namespace gait
