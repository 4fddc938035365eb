// Takes on disk, so that what was recorded is never lost: a text that people can read and mend.
//
//   gait takes 2
//   take LABEL INPUTS OUTPUTS
//   SECONDS in ... out ...        one line per frame, seconds since the take began
//   end
//   take ...
//
// A take without its `end`, the last of the file or one before another `take`, was cut off by the
// end of the program. Files of version 1 have `take LABEL FRAMES INPUTS OUTPUTS` and no `end`.
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
  bool finished = true;         // false: its recording was cut off

  int frames() const { return static_cast<int>(seconds.size()); }
  double duration() const { return seconds.empty() ? 0 : seconds.back(); }
};

void write_takes_header(std::ostream& file);
void write_take(const RecordedTake& take, std::ostream& file);
// The parts of that, for a take that is written while it is recorded.
void write_take_begin(const RecordedTake& take, std::ostream& file);
void write_frames(const RecordedTake& piece, std::ostream& file);
void write_take_end(std::ostream& file);

// Throws Error with file, line and what was expected. Of a take that was cut off, all whole frames
// are there.
std::vector<RecordedTake> read_takes(const std::filesystem::path& path);

// At `frame_rate`, linearly between the frames that came.
Take at_rate(const RecordedTake& take, double frame_rate);

}  // namespace gait
