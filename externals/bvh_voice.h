// One performer of [gait.bvh]: a clip that plays, a recording that grows. Alone in its box, or one
// of several (-poly), whose messages then begin with its number.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "gait/play/clips/clip_player.h"
#include "gait/play/clips/pose_recorder.h"
#include "pd/models.h"
#include "pd/ticker.h"

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

  // `number`: -1 when alone. `clip`: a file, a built-in walk, or empty for whatever built-in walk
  // fits.
  BvhVoice(const Around& around, int number, const std::string& clip);

  void take(const SharedModel& model);
  void say_ready(const std::string& model);
  void bang();
  void run(bool on);
  // False when it knows no such message. Throws Error when it cannot use it.
  bool message(const Arguments& arguments);
  // What comes at the right inlet.
  void cold(const Arguments& arguments);
  void print() const;
  void dump();

 private:
  struct Loaded {
    std::shared_ptr<const BodyMotion> motion;
    std::string reason;
  };

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
  // `selector` first, after the number of a voice among several.
  Outlet& begin(Outlet& outlet, const char* selector);
  void send(Outlet& outlet, const char* selector);

  Around around_;
  int number_;
  std::string clip_;  // path, or name of a built-in walk
  bool implied_;      // nobody asked for this clip
  SharedModel model_;
  std::unique_ptr<ClipPlayer> player_;
  std::unique_ptr<PoseRecorder> recorder_;
  std::shared_ptr<const BodyMotion> opened_, recorded_;
  bool recording_ = false, said_full_ = false;
  double speed_ = 1;
  int loop_values_ = 0;  // of the `loop` message: 0 off, 1 everything, 2 from A to B
  double loop_begin_ = 0, loop_end_ = 0;
  bool ended_ = false;
  int label_sent_ = -1;
  int loads_ = 0;  // asked for; an earlier one that is still under way counts for nothing
  std::vector<float> given_;
  Metronome clock_{[this] { bang(); }};
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
};

}  // namespace gait::pd
