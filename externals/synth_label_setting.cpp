#include "synth_label_setting.h"

#include "pd/named_argument.h"

namespace gait::pd {

namespace {

std::string no_label(const Model& model) {
  return "no such message, nor a label of " + model.name + ", which has " + names_of(model.labels);
}

}  // namespace

void LabelSetting::queue(const Arguments& arguments, const std::string& name,
                         Synthesiser* synthesiser) {
  if (!synthesiser) {
    if (waiting_.size() >= LabelQueue::capacity) arguments.fail("the queue is full");
    waiting_.push_back(name);
    return;
  }
  const Model& model = synthesiser->model();
  const int label = index_named(model.labels, name);
  if (label < 0) arguments.fail(no_label(model));
  if (!synthesiser->walker().queue(label))
    arguments.fail("the queue is full, or this label can never follow");
}

void LabelSetting::apply(Synthesiser& synthesiser,
                         const std::function<void(const std::string&)>& failed) {
  for (const std::string& name : waiting_) {
    const int label = index_named(synthesiser.model().labels, name);
    if (label < 0 || !synthesiser.walker().queue(label))
      failed("gait.synth: " + name + ": " + no_label(synthesiser.model()));
  }
  waiting_.clear();
}

}  // namespace gait::pd
