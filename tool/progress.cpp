#include "progress.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gait/platform/terminal.h"

namespace gait::tool {

Progress::Progress(std::string what) : what_(std::move(what)), watched_(rewrites_lines(stderr)) {}

Progress::~Progress() {
  if (!last_.empty()) std::fputs("\r\033[K", stderr);
}

void Progress::show(double share, const std::string& detail) {
  if (!watched_) return;
  const int percent = static_cast<int>(std::lround(100 * std::clamp(share, 0.0, 1.0)));
  std::string line = what_ + " " + std::to_string(percent) + " %";
  if (!detail.empty()) line += ", " + detail;
  if (line == last_) return;
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
  last_ = std::move(line);
}

}  // namespace gait::tool
