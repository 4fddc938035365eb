// Live recogniser (T14): frames of a sender as they come, at its rate, in; decisions at the model's
// rate out, with all a stage wants to know: walking or standing, which style, how unlike everything
// taught.
//
// It joins the resampling input stream, the recogniser, the standing detector and the style choice.
// Nothing allocates after construction.
#pragma once

#include <memory>
#include <span>

#include "gait/model/model.h"
#include "gait/play/input/input_stream.h"
#include "gait/play/recognise/recogniser.h"
#include "gait/play/recognise/standing_detector.h"
#include "gait/play/recognise/style_choice.h"

namespace gait {

// How unlike everything taught an observation is, 0 to 1, from its distance to the states decided
// on (Decision::distance): 0.5 at the `usual` one, below which 98 % of what was held out lay when
// the model was learnt (PlayDefaults::usual_distance).
float unlikeness(float distance, float usual) noexcept;

class LiveRecogniser {
 public:
  // `longest_gap`: seconds of silence after which a motion begins anew. Throws Error as Recogniser
  // and InputStream do.
  explicit LiveRecogniser(const PlayModel& played, const RecogniserSettings& settings = {},
                          double longest_gap = 1.0);

  // Push frames here; then call next() until it says false. (Streams go missing below.)
  InputStream& stream() noexcept { return stream_; }

  // Decides on the next frame that is due. False when there is none.
  bool next() noexcept;
  // Or takes frames at the model's rate, model.input.values values each, as Recogniser does: true
  // when it decided on one.
  bool advance(std::span<const float> values) noexcept;
  // After the last frame, until reset: decides on what the decoder's lag still holds back, a frame
  // a call. False when there is nothing more.
  bool flush() noexcept;
  // What comes next belongs to another motion.
  void begin_anew() noexcept;

  // Of the decision made last.
  const Recogniser& recogniser() const noexcept { return recogniser_; }
  const Decision& decision() const noexcept { return recogniser_.decision(); }
  bool first_of_run() const noexcept { return first_; }  // nothing before it is of its motion
  bool walking() const noexcept { return standing_.walking(); }
  float activity() const noexcept { return standing_.activity(); }
  int style() const noexcept { return choice_.style(); }  // -1: none leads yet
  float unlike() const noexcept {
    return unlikeness(decision().distance,
                      static_cast<float>(recogniser_.model().play.usual_distance));
  }
  // Whether the motion of the last third of a second is none that was taught: further off than 98 %
  // of what was held out.
  bool strange() const noexcept {
    return distance_ > static_cast<float>(recogniser_.model().play.usual_distance);
  }
  // Seconds by which the phase estimate is late at the time of the last frame pushed, and by which
  // the decision is.
  double estimate_late() const noexcept { return recogniser_.late() + stream_.waited(); }
  double decision_late() const noexcept {
    return recogniser_.lag() / recogniser_.model().frame_rate + stream_.waited();
  }

  void set_missing(int stream, bool missing) noexcept;
  void set_style_memory(float seconds) noexcept { recogniser_.set_style_memory(seconds); }
  StyleChoice& choice() noexcept { return choice_; }
  void reset() noexcept;

 private:
  void note_decided() noexcept;

  InputStream stream_;
  Recogniser recogniser_;
  StandingDetector standing_;
  StyleChoice choice_;
  bool first_ = true, next_is_first_ = true;
  float distance_ = 0, forget_;  // the decisions', leaking
};

}  // namespace gait
