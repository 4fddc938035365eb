// One performer of [gait.bvh]: plays a clip and records another. It is alone in its box, or one of
// several (-poly), whose messages then begin with its number.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "bvh_recorder.h"
#include "gait/play/clips/clip_player.h"
#include "pd/background.h"
#include "pd/models.h"
#include "pd/ticker.h"
#include "pd/voice_message.h"

namespace gait::pd {

class BvhVoice {
 public:
  // What the voices of a box share.
  struct Around {
    Box& box;
    Outlet &in, &pose, &info;
    Perf& perf;
    SlowError& slow_error;
    const t_glist* canvas;
    bool blocking;
    std::function<bool()> ready;  // there is a model to play a frame with
  };

  // `number`: -1 when alone. `clip`: a file or a built-in walk; empty: the performer's own built-in
  // walk.
  BvhVoice(const Around& around, int number, const std::string& clip);

  void take(const SharedModel& model);
  void say_ready(const std::string& model);
  void bang();
  void run(bool on);
  // False when it knows no such message. Throws Error when it cannot use it.
  bool message(const Arguments& arguments);
  // A message at the right inlet. Only with a model.
  void cold(const Arguments& arguments) {
    recorder_->take(arguments, around_.box, around_.slow_error);
  }
  void print() const;
  void dump();

 private:
  void open(const Arguments& arguments);
  void loop(const Arguments& arguments);
  void set_rate(const Arguments& arguments);
  void record(const Arguments& arguments);
  void clear(const Arguments& arguments);
  void write(const Arguments& arguments);

  // Makes a motion on the worker and plays it from then on.
  void load(std::function<BodyMotion()> make, bool recording);
  void load_clip();
  void play(std::shared_ptr<const BodyMotion> motion);
  void go_to(double seconds);
  void step();
  void show();
  VoiceMessage to(Outlet& outlet, const char* selector) { return {outlet, number_, selector}; }

  Around around_;
  int number_;
  std::string clip_;  // path, or name of a built-in walk
  bool implied_;      // no message and no argument named the clip
  SharedModel model_;
  std::unique_ptr<ClipPlayer> player_;
  std::unique_ptr<BvhRecorder> recorder_;
  std::shared_ptr<const BodyMotion> opened_, recorded_;
  double speed_ = 1;
  int loop_values_ = 0;  // of the `loop` message: 0 off, 1 everything, 2 from A to B
  double loop_begin_ = 0, loop_end_ = 0;
  bool ended_ = false;
  int label_sent_ = -1;
  int loads_ = 0;  // begun so far; only the last one's clip is played
  Metronome clock_{[this] { bang(); }};
  Background background_;
};

}  // namespace gait::pd
