// Labels that [gait.synth] was told to walk through, by name, kept until the model is there.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gait/play/synthesise/synthesiser.h"
#include "pd/arguments.h"

namespace gait::pd {

class LabelSetting {
 public:
  // Queues the label. `synthesiser` may be null (no model yet). Throws Error, with nothing changed,
  // when there is no such label, it cannot follow, or the queue is full.
  void queue(const Arguments& arguments, const std::string& name, Synthesiser* synthesiser);
  // Queues what waited; labels that the model lacks are told to `failed` and forgotten.
  void apply(Synthesiser& synthesiser, const std::function<void(const char*)>& failed);
  void clear() { waiting_.clear(); }

 private:
  std::vector<std::string> waiting_;
};

}  // namespace gait::pd
