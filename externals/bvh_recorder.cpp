#include "bvh_recorder.h"

namespace gait::pd {

BvhRecorder::BvhRecorder(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      recorder_(model_),
      given_(3 * model_->body->skeleton.joints.size()) {}

void BvhRecorder::start() {
  recording_ = true;
  said_full_ = false;
  recorder_.clear();
}

std::shared_ptr<PoseRecorder::Recording> BvhRecorder::stop() {
  recording_ = said_full_ = false;
  return std::make_shared<PoseRecorder::Recording>(recorder_.finish());
}

void BvhRecorder::take(const Arguments& arguments, Box& box, SlowError& slow_error) {
  const auto selector = arguments.selector();
  if (selector != "pose" && selector != "in" && selector != "out" && selector != "root")
    arguments.fail("no such message at the right inlet");
  if (!recording_) return;
  if (recorder_.full()) {
    if (!said_full_)
      logpost(&box, 1, "%s: the recording is full after %g s; `record 0` keeps it", box.name(),
              recorder_.frames() / model_->frame_rate);
    said_full_ = true;
    return;
  }
  const Body& body = *model_->body;
  const std::size_t count = selector == "root"  ? 4
                            : selector == "in"  ? 3 * body.input_joints.size()
                            : selector == "out" ? 3 * body.output_joints.size()
                                                : given_.size();
  const std::span<float> values(given_.data(), count);
  const double now = clock_gettimesince(0) / 1000;
  const bool taken =
      count <= given_.size() && arguments.read(values) &&
      (selector == "root"  ? recorder_.take_root({values[0], values[1], values[2]}, values[3])
       : selector == "in"  ? recorder_.take_inputs(values, now)
       : selector == "out" ? recorder_.take_outputs(values, now)
                           : recorder_.take_pose(values, now));
  if (!taken)
    slow_error.say([&] {
      return std::string(selector) + ": expected " + std::to_string(count) + " numbers, got " +
             std::to_string(arguments.size());
    });
}

}  // namespace gait::pd
