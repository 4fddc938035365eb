#include "gait/play/recognise/style_choice.h"

#include <algorithm>

namespace gait {

bool StyleChoice::advance(std::span<const float> posteriors) noexcept {
  if (posteriors.empty()) return false;
  const auto best = std::max_element(posteriors.begin(), posteriors.end());
  float second = 0;
  for (auto other = posteriors.begin(); other != posteriors.end(); ++other)
    if (other != best) second = std::max(second, *other);
  const int leader = *best - second >= margin_ ? static_cast<int>(best - posteriors.begin()) : -1;
  led_ = leader == leading_ ? led_ : 0;
  leading_ = leader;
  if (leader < 0 || leader == style_) return false;
  led_ = std::min(led_ + 1, 1 << 30);
  if (led_ < hold_ * frame_rate_) return false;
  style_ = leader;
  return true;
}

void StyleChoice::reset() noexcept {
  style_ = leading_ = -1;
  led_ = 0;
}

}  // namespace gait
