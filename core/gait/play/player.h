// Player: input values in, decisions and output values out, a frame at a time at the model's rate.
// It joins recogniser, mapping and trajectory, whatever the streams are.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gait/model/model.h"
#include "gait/play/map/covariance_map.h"
#include "gait/play/recognise/recogniser.h"
#include "gait/play/synthesise/trajectory.h"

namespace gait {

// What is not said is the model's own default.
struct PlayerSettings : RecogniserSettings {
  std::optional<double> strength;
  std::optional<int> past, future;  // frames of state queue: P, F
  int current = 1;                  // C
};

class Player {
 public:
  // Throws Error when the model cannot be played (see make_state_tables).
  explicit Player(const PlayModel& played, const PlayerSettings& settings = {});

  // Takes the next frame: model.input.values values, missing ones ignored; one that is not finite,
  // or absurdly far (see Recogniser), is as the frame before had it. Afterwards `available` frames
  // can be read.
  void advance(std::span<const float> values) noexcept;
  // After the last frame, until reset: hands out what delays still hold back. False when there is
  // nothing more; else frames are `available`.
  bool flush() noexcept;

  // How many output frames the last call made: 0 while the delay fills, then C every C frames.
  int available() const noexcept { return available_; }
  // Frame `i` of those, oldest first. Output values: model.output.values of them.
  std::span<const float> output(int i) const noexcept;
  const Decision& decision(int i) const noexcept;
  std::span<const float> styles(int i) const noexcept;

  // What is known already about the last frame given (less the decoder's lag).
  const Decision& latest() const noexcept { return recogniser_.decision(); }
  std::span<const float> latest_styles() const noexcept { return recogniser_.styles(); }

  // Frames by which output is late: the decoder's lag and the trajectory's future.
  int delay() const noexcept { return recogniser_.lag() + trajectory_.delay(); }

  // See Recogniser.
  void set_missing(int value, bool missing) noexcept { recogniser_.set_missing(value, missing); }
  bool settled() const noexcept { return recogniser_.settled(); }

  void set_strength(float strength) noexcept { map_.set_strength(strength); }
  void set_strength(int value, float strength) noexcept { map_.set_strength(value, strength); }
  void reset() noexcept;

  const Model& model() const noexcept { return recogniser_.model(); }

 private:
  struct Held {  // what later frames still need of a frame
    Decision decision;
    std::vector<float> styles;
  };

  // Maps the frame that was decided on.
  void map_decided() noexcept;
  void emit(const Eigen::Ref<const Eigen::MatrixXf>& statics) noexcept;
  int slot(int frame) const noexcept { return frame % static_cast<int>(ring_.size()); }

  Recogniser recogniser_;
  CovarianceMap map_;
  Trajectory trajectory_;
  std::vector<Held> ring_;
  int mapped_ = 0, emitted_ = 0;   // frames so far
  Eigen::MatrixXf outputs_;        // values by C or more
  std::vector<int> output_slots_;  // ring slot of each of them
  int available_ = 0;
};

}  // namespace gait
