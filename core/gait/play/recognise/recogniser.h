// Recogniser (T14 §3, §4.1): input values in, what is being done and how out, a frame at a time at
// the model's rate.
//
// It joins observation, emissions, decoder, phase and style recogniser, whatever the streams are.
// What it says of a frame is all that mapping needs, so that the two need not know each other.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gait/model/model.h"
#include "gait/motion/observation.h"
#include "gait/play/play_model.h"
#include "gait/play/recognise/decoder.h"
#include "gait/play/recognise/emissions.h"
#include "gait/play/recognise/phase_clock.h"
#include "gait/play/recognise/phase_estimate.h"
#include "gait/play/recognise/style_recogniser.h"
#include "gait/play/recognise/table_maker.h"

namespace gait {

// What is not said is the model's own default.
struct RecogniserSettings {
  std::optional<DecoderKind> decoder;
  std::optional<double> lag;  // seconds, for DecoderKind::lag
  std::optional<double> temper;
  std::optional<double> style_memory;  // seconds
};

// What was decided about one frame.
struct Decision {
  int label = 0;  // index into the model's labels
  int state = 0;  // within the label
  float log_likelihood = 0;
  float progress = 0;  // through the label, 0 to 1
  float phase = 0;     // through the cycle of labels, 0 to 1, smoothed by a phase clock
  float cadence = 0;   // labels per second; of a walk, steps per second
  // Of the observation, as it was before it was clipped, from what was taught; about 1 for that.
  float distance = 0;
};

class Recogniser {
 public:
  // Throws Error when the model cannot be played (see make_state_tables).
  explicit Recogniser(const PlayModel& played, const RecogniserSettings& settings = {});

  // Takes the next frame: model.input.values values, missing ones ignored; one that is not finite,
  // or over 10000 deviations from its mean (no rotation is), is as the frame before had it. True
  // when it decided on a frame, the one `lag()` frames before this; what follows then speaks of
  // that one.
  bool advance(std::span<const float> values) noexcept;
  // After the last frame, until reset: decides on what the lag still holds back, a frame a call.
  // False when there is nothing more.
  bool flush() noexcept;

  const Decision& decision() const noexcept { return decision_; }
  // The states decided on with their weights, the likeliest first; numbered over all labels.
  std::span<const WeightedState> states() const noexcept {
    return {states_.data(), static_cast<std::size_t>(state_count_)};
  }
  // Of each of them, how far the observation is (as Decision::distance, which is their mean).
  std::span<const float> distances() const noexcept {
    return {distances_.data(), static_cast<std::size_t>(state_count_)};
  }
  // One posterior per style; empty for models without styles.
  std::span<const float> styles() const noexcept { return styles_.posteriors(); }
  // The observation as the model scales it, clipped or not yet, and in the streams' own units; of
  // each the first
  // `known` entries are real, the rest await their history.
  const Eigen::VectorXf& scaled() const noexcept { return held(decided_back_).scaled; }
  const Eigen::VectorXf& unclipped() const noexcept { return held(decided_back_).unclipped; }
  const Eigen::VectorXf& observation() const noexcept { return held(decided_back_).raw; }
  int known() const noexcept { return held(decided_back_).known; }
  // Whether the emissions are still those of that observation, and then its innovation in a state:
  // whitened once, it need not be for mapping.
  bool whitened() const noexcept { return decided_back_ == 0; }
  Eigen::Map<const Eigen::VectorXf> innovation(int state) const noexcept {
    return emissions_.innovation(state);
  }
  // The phase for a clock to follow, and its age at the time of the last frame taken: the
  // estimate's own and the decoder's lag (seconds).
  const PhaseEstimate& phase_estimate() const noexcept { return estimate_; }
  double late() const noexcept { return estimate_.age + lag() / model_->frame_rate; }

  // Input values that the decoder does not look at, ascending.
  std::span<const int> missing() const noexcept { return unseen_; }
  const std::shared_ptr<const StateTables>& tables() const noexcept { return current_; }

  int lag() const noexcept { return decoder_.lag(); }  // frames by which decisions are late
  // How the model's own mean walk goes: what a clock begins with.
  PhaseClockSettings clock_settings() const { return clock_settings_of(*model_, phase_); }

  // An input value that is missing is held, then left out of the decoder as soon as tables without
  // it are made; when it comes back, it counts again once its whole history is real.
  void set_missing(int value, bool missing) noexcept { missing_[value] = missing; }
  // Whether the decoder sees exactly the inputs that are there with their history; false while
  // tables for that are awaited.
  bool settled() const noexcept { return !awaiting_ && wanted_ == masked_; }

  // Not walking: the phase stands, whatever states are decided on.
  void set_walking(bool walking) noexcept { clock_.set_walking(walking); }
  void set_style_memory(float seconds) noexcept { styles_.set_memory(seconds); }
  void reset() noexcept;

  const Model& model() const noexcept { return *model_; }

 private:
  struct Held {  // what deciding later still needs of a frame
    Eigen::VectorXf scaled, unclipped, raw;
    Eigen::VectorXf squared_distances;  // per state
    bool clipped = false;
    int known = 0;
    int seen = 0;  // entries that the distances count
  };

  static PhaseClockSettings clock_settings_of(const Model& model, const PhaseEstimator& phase);
  void set_bounds();
  void hold_missing(std::span<const float> values) noexcept;
  void keep_tables_current() noexcept;
  void note_unseen() noexcept;
  // Decides about the frame taken `back` frames ago.
  void decide(int back, int state, std::span<const WeightedState> states, float progress) noexcept;
  void note_distances(const Held& frame) noexcept;
  void follow_phase() noexcept;
  PhaseEstimate phase_seen() noexcept;
  const Held& held(int back) const noexcept;

  std::shared_ptr<const Model> model_;
  std::shared_ptr<const StateTables> tables_, current_;
  InputObserver<float> observer_;
  Emissions emissions_;
  Whitening unclipped_;
  Decoder decoder_;
  PhaseEstimator phase_;
  Whitening late_whitening_;  // of a frame decided later
  PhaseClock clock_;
  bool cyclic_;  // the labels form a cycle that a clock can follow
  StyleRecogniser styles_;
  TableMaker maker_;

  std::vector<float> values_;          // held values, one per input value
  Eigen::ArrayXf lowest_, highest_;    // of each, what can be a measurement
  std::vector<bool> missing_;          // as set
  std::vector<int> returned_;          // real frames in a row, up to the history and one
  std::vector<bool> wanted_, masked_;  // masks: that should be, that is in the tables or asked for
  bool awaiting_ = false;              // asked, and not taken yet
  bool old_to_return_ = false;         // new tables are in use, the old ones not given back yet
  std::vector<int> unseen_;

  std::vector<Held> ring_;
  int newest_ = 0;
  int taken_ = 0, decided_ = 0;  // frames so far
  int decided_back_ = 0;         // of the last decision, counted from the last frame taken
  Decision decision_;
  std::vector<WeightedState> states_;
  std::vector<float> distances_;
  int state_count_ = 0;
  std::vector<float> seen_phases_;  // scratch: one per decided state
  PhaseEstimate estimate_;
};

}  // namespace gait
