// What a performer of [gait.bvh] records: frames that come at the right inlet as `pose`, `in`,
// `out` and `root`.
#pragma once

#include <memory>
#include <vector>

#include "gait/play/clips/pose_recorder.h"
#include "pd/arguments.h"
#include "pd/report.h"

namespace gait::pd {

class BvhRecorder {
 public:
  // `model`: with a body.
  explicit BvhRecorder(std::shared_ptr<const Model> model);

  bool recording() const { return recording_; }
  void start();
  // Ends the recording and gives it, without frames when none came.
  std::shared_ptr<PoseRecorder::Recording> stop();
  // Forgets the frames; a recording under way goes on.
  void clear() { recorder_.clear(); }
  // A frame's message, which counts while recording. Throws Error when it is no such message;
  // numbers that do not fit go to `slow_error`.
  void take(const Arguments& arguments, Box& box, SlowError& slow_error);

 private:
  std::shared_ptr<const Model> model_;
  PoseRecorder recorder_;
  bool recording_ = false, said_full_ = false;
  std::vector<float> given_;
};

}  // namespace gait::pd
