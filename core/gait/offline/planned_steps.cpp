#include <cmath>

#include "gait/model/body_pose.h"
#include "gait/motion/resample.h"
#include "gait/offline/planned_walk.h"
#include "gait/offline/walk_recorder.h"
#include "gait/play/synthesise/step_walker.h"

namespace gait {

Clip stepped_walk(const std::shared_ptr<const Model>& model, const StyledWalkPlan& plan) {
  StepWalker walker(model);
  required_body(*model);
  std::vector<std::vector<float>> wanted;
  for (const StyleChange& change : plan.changes)
    wanted.push_back(style_weights(*model, change.mix));
  if (!plan.mix.empty()) walker.set_weights(style_weights(*model, plan.mix));

  const double rate = model->frame_rate;
  WalkRecorder recorder(*model->body, rate, 1, plan.turn);
  const auto led = static_cast<int>(std::ceil(lead_in_seconds * rate));
  walker.advance();
  for (int frame = 0; frame < led || walker.entered() != 0; ++frame) {
    recorder.lead_in(walker.pose());
    walker.advance();
  }
  const auto frames = static_cast<int>(std::lround(std::max(0.0, plan.seconds) * rate)) + 1;
  std::size_t changed = 0;
  int begun = 0;  // cycles: how often the first label was entered
  bool done = false;
  while (!done) {
    for (; changed < wanted.size() &&
           plan.changes[changed].seconds <= recorder.frames() / rate + 1e-9;
         ++changed)
      walker.set_weights(wanted[changed]);
    if (walker.entered() == 0) ++begun;
    recorder.add(walker.pose());
    done = plan.cycles > 0 ? begun > plan.cycles : recorder.frames() >= frames;
    walker.advance();
  }
  const Clip clip = recorder.clip("walk");
  return plan.frame_rate > 0 && plan.frame_rate != rate ? resampled(clip, plan.frame_rate) : clip;
}

}  // namespace gait
