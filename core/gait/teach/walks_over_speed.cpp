#include "gait/teach/walks_over_speed.h"

#include <algorithm>

namespace gait {

namespace {

constexpr double least_range = 1.25;  // of speeds: highest over lowest

bool has_range(const SubjectCycles& subject) {
  const auto [slow, fast] =
      std::minmax_element(subject.cycles.begin(), subject.cycles.end(),
                          [](const auto& a, const auto& b) { return a.speed < b.speed; });
  return slow != subject.cycles.end() && slow->speed > 0 && fast->speed > least_range * slow->speed;
}

}  // namespace

std::vector<Walk> walks_over_speed(const std::vector<Walk>& walks) {
  std::vector<Walk> over_speed;
  for (const Walk& walk : walks)
    if (walk.style.empty() || walk.style == "neutral" || walk.style == "normal" ||
        walk.style == "standing")
      over_speed.push_back(walk);
  return over_speed;
}

void add_speed_spaces(Model& model, const std::vector<Walk>& walks, const SpeedOptions& options) {
  model.speed_spaces.clear();
  model.shared_speed_space.reset();
  const std::vector<Walk> over_speed = walks_over_speed(walks);
  if (!model.body || over_speed.empty()) return;
  const std::vector<SubjectCycles> subjects = cycles_of_subjects(over_speed, *model.body, options);
  if (std::none_of(subjects.begin(), subjects.end(), has_range)) return;
  SpeedSpaces spaces = learn_speed_spaces(subjects, *model.body, options);
  model.speed_spaces = std::move(spaces.subjects);
  model.shared_speed_space = std::move(spaces.shared);
}

}  // namespace gait
