// Captured walks of many speeds, and the speed walker that learnt them.
#pragma once

#include <memory>
#include <vector>

#include "gait/learn/speed_space.h"
#include "gait/play/cycles/speed_walker.h"

namespace gait::testing {

struct Captured {
  std::vector<Walk> walks;
  Body body;
  std::vector<SubjectCycles> subjects;
};

// All of cmu-walks; read once.
const Captured& captured();
std::shared_ptr<Model> model_of(const std::vector<SubjectCycles>& subjects);
const std::shared_ptr<Model>& whole_model();
SpeedWalker walker();  // of the whole model

}  // namespace gait::testing
