#include "gait/motion/steps.h"

namespace gait {

std::vector<Step> steps_between(const std::vector<Contact>& contacts) {
  std::vector<Step> steps;
  for (std::size_t i = 0; i + 1 < contacts.size(); ++i)
    if (contacts[i].foot != contacts[i + 1].foot)
      steps.push_back(
          {contacts[i].frame, contacts[i + 1].frame, contacts[i].foot, contacts[i].offset});
  return steps;
}

std::vector<Cycle> cycles_between(const std::vector<Contact>& contacts) {
  std::vector<Cycle> cycles;
  for (std::size_t i = 0; i + 2 < contacts.size(); ++i)
    if (contacts[i].foot == Foot::right && contacts[i + 1].foot == Foot::left &&
        contacts[i + 2].foot == Foot::right)
      cycles.push_back({contacts[i].frame, contacts[i + 2].frame});
  return cycles;
}

}  // namespace gait
