// Labels for [gait.synth]'s queue, by name; kept until the model is there.
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
  // Queues what waited; a label that the model lacks is dropped, and `failed` gets the reason.
  void apply(Synthesiser& synthesiser, const std::function<void(const std::string&)>& failed);
  void clear() { waiting_.clear(); }

 private:
  std::vector<std::string> waiting_;
};

}  // namespace gait::pd
