#include "label_setting.h"

#include "gait/names.h"

namespace gait::pd {

namespace {

int label_named(const Model& model, const std::string& name) {
  for (std::size_t i = 0; i < model.labels.size(); ++i)
    if (model.labels[i].name == name) return static_cast<int>(i);
  return -1;
}

std::string labels_of(const Model& model) { return joined_names(model.labels, &Label::name); }

}  // namespace

void LabelSetting::queue(const Arguments& arguments, const std::string& name,
                         Synthesiser* synthesiser) {
  if (!synthesiser) {
    if (waiting_.size() >= LabelQueue::capacity) arguments.fail("the queue is full");
    waiting_.push_back(name);
    return;
  }
  const Model& model = synthesiser->model();
  const int label = label_named(model, name);
  if (label < 0)
    arguments.fail("no such message, nor a label of " + model.name + ", which has " +
                   labels_of(model));
  if (!synthesiser->walker().queue(label))
    arguments.fail("the queue is full, or this label can never follow");
}

void LabelSetting::apply(Synthesiser& synthesiser, const std::function<void(const char*)>& failed) {
  for (const std::string& name : waiting_) {
    const int label = label_named(synthesiser.model(), name);
    if (label < 0 || !synthesiser.walker().queue(label))
      failed(("gait.synth: " + name + ": no such message, nor a label of " +
              synthesiser.model().name + ", which has " + labels_of(synthesiser.model()))
                 .c_str());
  }
  waiting_.clear();
}

}  // namespace gait::pd
