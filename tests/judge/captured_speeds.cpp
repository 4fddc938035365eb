#include "judge/captured_speeds.h"

#include <filesystem>

#include "judge/real_walks.h"

namespace gait::testing {

const Captured& captured() {
  static const Captured all = [] {
    Captured made;
    made.walks = real_walks("cmu-walks", [](const std::string&) { return true; });
    for (Walk& walk : made.walks)
      walk.subject = std::filesystem::path(walk.clip.name).filename().string().substr(0, 2);
    made.body = body_of_subjects(made.walks);
    made.subjects = cycles_of_subjects(made.walks, made.body);
    return made;
  }();
  return all;
}

std::shared_ptr<Model> model_of(const std::vector<SubjectCycles>& subjects) {
  auto model = std::make_shared<Model>();
  model->body = captured().body;
  SpeedSpaces spaces = learn_speed_spaces(subjects, captured().body);
  model->speed_spaces = std::move(spaces.subjects);
  model->shared_speed_space = std::move(spaces.shared);
  return model;
}

const std::shared_ptr<Model>& whole_model() {
  static const std::shared_ptr<Model> model = model_of(captured().subjects);
  return model;
}

SpeedWalker walker() {
  static const auto tables = make_speed_tables(*whole_model());
  return SpeedWalker(tables);
}

}  // namespace gait::testing
