// Player: input values in, decisions and output values out, a frame at a time at the model's rate.
// It joins observation, decoder, style recogniser, mapping and trajectory, whatever the streams
// are.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gait/model/model.h"
#include "gait/motion/observation.h"
#include "gait/play/covariance_map.h"
#include "gait/play/decoder.h"
#include "gait/play/emissions.h"
#include "gait/play/phase_clock.h"
#include "gait/play/phase_estimate.h"
#include "gait/play/style_recogniser.h"
#include "gait/play/table_maker.h"
#include "gait/play/trajectory.h"

namespace gait {

// What is not said is the model's own default.
struct PlayerSettings {
  std::optional<DecoderKind> decoder;
  std::optional<double> lag;  // seconds, for DecoderKind::lag
  std::optional<double> temper;
  std::optional<double> strength;
  std::optional<int> past, future;  // frames of state queue: P, F
  int current = 1;                  // C
  std::optional<double> style_memory;
};

// What was decided about one frame.
struct Decision {
  int label = 0;  // index into the model's labels
  int state = 0;  // within the label
  float log_likelihood = 0;
  float progress = 0;  // through the label, 0 to 1
  float phase = 0;     // through the cycle of labels, 0 to 1, smoothed by a phase clock
  float cadence = 0;   // labels per second; of a walk, steps per second
  float distance = 0;  // of the observation from what was taught; about 1 for that
};

class Player {
 public:
  // `tables`: the model's, if somebody made them already; several players may share them. Throws
  // Error when the model cannot be played (see make_state_tables).
  Player(std::shared_ptr<const Model> model, const PlayerSettings& settings = {},
         std::shared_ptr<const StateTables> tables = nullptr);

  // Takes the next frame: model.input.values values, missing ones ignored; one that is not finite
  // is as the frame before had it. Afterwards `available` frames can be read.
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
  const Decision& latest() const noexcept { return latest_; }
  std::span<const float> latest_styles() const noexcept { return styles_.posteriors(); }

  // Frames by which output is late: the decoder's lag and the trajectory's future.
  int delay() const noexcept { return decoder_.lag() + trajectory_.delay(); }

  // An input value that is missing is held, then left out of the decoder as soon as tables without
  // it are made; when it comes back, it counts again once its whole history is real.
  void set_missing(int value, bool missing) noexcept;
  // Whether the decoder sees exactly the inputs that are there with their history; false while
  // tables for that are awaited.
  bool settled() const noexcept { return !awaiting_ && wanted_ == masked_; }

  void set_strength(float strength) noexcept { map_.set_strength(strength); }
  void set_strength(int value, float strength) noexcept { map_.set_strength(value, strength); }
  void reset() noexcept;

  const Model& model() const noexcept { return *model_; }

 private:
  struct Held {  // what later frames still need of a frame
    Eigen::VectorXf x;
    int known = 0;
    Decision decision;
    std::vector<float> styles;
  };

  void hold_missing(std::span<const float> values) noexcept;
  void keep_tables_current() noexcept;
  // Decides about the frame taken `back` frames ago and maps it.
  void decide(int back, int state, std::span<const WeightedState> states, float progress) noexcept;
  void follow_phase(std::span<const WeightedState> states, Decision& decision) noexcept;
  void emit(const Eigen::Ref<const Eigen::MatrixXf>& statics) noexcept;
  int slot(int back) const noexcept;

  std::shared_ptr<const Model> model_;
  std::shared_ptr<const StateTables> tables_;
  InputObserver<float> observer_;
  Emissions emissions_;
  Decoder decoder_;
  PhaseEstimator phase_;
  PhaseClock clock_;
  bool cyclic_;  // the labels form a cycle that a clock can follow
  StyleRecogniser styles_;
  CovarianceMap map_;
  Trajectory trajectory_;
  TableMaker maker_;

  std::vector<float> values_;          // held values, one per input value
  std::vector<bool> missing_;          // as told
  std::vector<int> returned_;          // real frames in a row, up to the history and one
  std::vector<bool> wanted_, masked_;  // masks: that should be, that is in the tables or asked for
  bool awaiting_ = false;              // asked, and not taken yet
  std::vector<Held> ring_;
  int newest_ = 0;
  int taken_ = 0, mapped_ = 0, emitted_ = 0;  // frames so far
  Decision latest_;
  Eigen::MatrixXf outputs_;        // values by C or more
  std::vector<int> output_slots_;  // ring slot of each of them
  int available_ = 0;
};

}  // namespace gait
