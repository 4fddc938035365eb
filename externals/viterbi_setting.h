// The settings of [gait.viterbi~]. They may be made before the model is there, and hold for the
// models that follow.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gait/play/recognise/live_recogniser.h"
#include "pd/outlet.h"

namespace gait::pd {

class ViterbiSetting {
 public:
  // Each takes the message of its name. Throws Error, with nothing changed, when the message does
  // not fit. `model`: null before it is there.
  void decoder(const Arguments& arguments);  // viterbi | forward | lag SECONDS
  void mask(const Arguments& arguments, const Model* model);
  void on_lost(const Arguments& arguments);
  void rate(const Arguments& arguments);
  void memory(const Arguments& arguments);
  void margin(const Arguments& arguments);
  void hold(const Arguments& arguments);
  void timeout(const Arguments& arguments);
  void ahead(const Arguments& arguments);

  // Drops masks of inputs that this model lacks, and returns the names of these.
  std::vector<std::string> forget_unknown(const Model& model);
  // The settings that a recogniser is made with; apply() sets all others at any time.
  const RecogniserSettings& recognising() const { return recognising_; }
  bool same_recogniser(const RecogniserSettings& other) const {
    return recognising_.decoder == other.decoder && recognising_.lag == other.lag;
  }
  void apply(LiveRecogniser& live, const Model& model) const;

  double rate() const { return rate_; }        // of the sender, frames/s; 0: by arrival
  double timeout() const { return timeout_; }  // seconds without a frame: the stream is lost
  double ahead() const { return ahead_; }      // seconds by which contacts are early
  std::optional<double> going_on() const { return going_on_; }  // seconds; none: for ever

  void dump(Outlet& info) const;

 private:
  struct Mask {
    std::string input;  // a name or a number
    bool there;
  };

  RecogniserSettings recognising_;
  std::vector<Mask> masks_;  // later ones count more
  bool walks_on_ = true;
  std::optional<double> going_on_, lost_seconds_;
  double rate_ = 0, timeout_ = 0.25, ahead_ = 0;
  std::optional<float> memory_;
  float margin_ = 0.1f;
  double hold_ = 0.3;
};

}  // namespace gait::pd
