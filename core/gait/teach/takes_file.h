// Takes on disk, so that what was recorded is never lost: a text that people can read and mend.
//
//   gait takes 1
//   take LABEL FRAMES INPUTS OUTPUTS
//   SECONDS in ... out ...        one line per frame, seconds since the take began
//   take ...
//
// A label with a space or quote in it is written in double quotes, with \" and \\ inside.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "gait/teach/takes.h"

namespace gait {

// A take as it was recorded, at whatever moments frames came.
struct RecordedTake {
  std::string label;
  int inputs = 0, outputs = 0;  // values per frame
  std::vector<double> seconds;  // since the take began, ascending
  std::vector<float> values;    // frame after frame, inputs then outputs

  int frames() const { return static_cast<int>(seconds.size()); }
  double duration() const { return seconds.empty() ? 0 : seconds.back(); }
};

void write_takes_header(std::ostream& file);
void write_take(const RecordedTake& take, std::ostream& file);

// Throws Error with file, line and what was expected. A last take that was cut off is left out.
std::vector<RecordedTake> read_takes(const std::filesystem::path& path);

// At `frame_rate`, linearly between the frames that came.
Take at_rate(const RecordedTake& take, double frame_rate);

}  // namespace gait
