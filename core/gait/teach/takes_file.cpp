#include "gait/teach/takes_file.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "gait/error.h"
#include "gait/platform/path_text.h"
#include "gait/platform/whole_file.h"

namespace gait {

namespace {

constexpr const char *first_line = "gait takes 2", *first_line_before = "gait takes 1";
constexpr int most_values = 10000, most_frames = 10000000;

[[noreturn]] void fail(const std::string& path, int line, const std::string& expected) {
  throw Error(path + ":" + std::to_string(line) + ": expected " + expected);
}

// A frame's line into the take; false when it is not one.
bool read_frame(const std::string& line, RecordedTake& take) {
  std::istringstream words(line);
  double seconds = 0;
  if (!(words >> seconds) || !std::isfinite(seconds)) return false;
  if (!take.seconds.empty() && seconds <= take.seconds.back()) return false;
  const std::size_t count = take.values.size();
  float value = 0;
  while (words >> value) {
    if (!std::isfinite(value)) return false;
    take.values.push_back(value);
  }
  if (!words.eof() ||
      take.values.size() - count != static_cast<std::size_t>(take.inputs + take.outputs))
    return false;
  take.seconds.push_back(seconds);
  return true;
}

// The first line of a take; `frames` only where they are counted.
bool read_take_begin(const std::string& line, bool counted, RecordedTake& take, int& frames) {
  std::istringstream words(line);
  std::string word;
  if (!(words >> word) || word != "take") return false;
  words >> std::ws;
  if (words.peek() == '"')
    words >> std::quoted(take.label);
  else
    words >> take.label;
  if (counted && !(words >> frames)) return false;
  return words >> take.inputs >> take.outputs && frames >= 0 && frames <= most_frames &&
         take.inputs >= 0 && take.outputs >= 0 && take.inputs + take.outputs <= most_values;
}

}  // namespace

void write_takes_header(std::ostream& file) { file << first_line << '\n'; }

void write_take(const RecordedTake& take, std::ostream& file) {
  write_take_begin(take, file);
  write_frames(take, file);
  write_take_end(file);
}

void write_take_begin(const RecordedTake& take, std::ostream& file) {
  const bool plain =
      !take.label.empty() && take.label.find_first_of(" \t\"\\") == std::string::npos;
  file << "take ";
  if (plain)
    file << take.label;
  else
    file << std::quoted(take.label);
  file << ' ' << take.inputs << ' ' << take.outputs << '\n';
}

void write_frames(const RecordedTake& take, std::ostream& file) {
  const auto width = static_cast<std::size_t>(take.inputs + take.outputs);
  file << std::setprecision(9);
  for (std::size_t frame = 0; frame < take.seconds.size(); ++frame) {
    file << take.seconds[frame];
    for (std::size_t i = 0; i < width; ++i) file << ' ' << take.values[frame * width + i];
    file << '\n';
  }
}

void write_take_end(std::ostream& file) { file << "end\n"; }

std::vector<RecordedTake> read_takes(const std::filesystem::path& file_path) {
  std::ifstream file = open_to_read(file_path, "recorded takes");
  const std::string path = utf8_of(file_path);
  std::string line;
  int number = 1;
  std::getline(file, line);
  const bool counted = line == first_line_before;
  if (!counted && line != first_line)
    fail(path, number, std::string(1, '\'').append(first_line).append(1, '\''));
  std::vector<RecordedTake> takes;
  // A line without its end was cut off by a crash in the midst of writing.
  const auto next_line = [&] {
    ++number;
    return static_cast<bool>(std::getline(file, line)) && !file.eof();
  };
  bool more = next_line();
  while (more) {
    if (line.empty()) {
      more = next_line();
      continue;
    }
    RecordedTake take;
    int frames = most_frames;
    if (!read_take_begin(line, counted, take, frames))
      fail(path, number,
           counted ? "take LABEL FRAMES INPUTS OUTPUTS" : "take LABEL INPUTS OUTPUTS");
    const auto add_frame = [&] {
      if (!read_frame(line, take))
        fail(path, number,
             "seconds, greater than before, and " + std::to_string(take.inputs + take.outputs) +
                 " numbers" + (counted ? "" : ", or 'end'"));
    };
    if (counted) {
      while (take.frames() < frames && (more = next_line())) add_frame();
      take.finished = take.frames() == frames;
    } else {
      while ((more = next_line()) && line != "end" && !line.starts_with("take ")) add_frame();
      take.finished = more && line == "end";
    }
    if (take.finished) more = next_line();
    if (take.finished || (!counted && take.frames() > 0)) takes.push_back(std::move(take));
  }
  return takes;
}

Take at_rate(const RecordedTake& take, double frame_rate) {
  Take result;
  result.label = take.label;
  const int frames = take.frames() == 0
                         ? 0
                         : static_cast<int>(std::floor(take.duration() * frame_rate + 1e-6)) + 1;
  result.inputs.resize(take.inputs, frames);
  result.outputs.resize(take.outputs, frames);
  const int width = take.inputs + take.outputs;
  using Row = Eigen::Map<const Eigen::VectorXf>;
  std::size_t after = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const double at = frame / frame_rate;
    while (after + 1 < take.seconds.size() && take.seconds[after] < at) ++after;
    const std::size_t before = after > 0 ? after - 1 : 0;
    const double gap = take.seconds[after] - take.seconds[before];
    const auto share =
        static_cast<float>(gap > 0 ? std::clamp((at - take.seconds[before]) / gap, 0.0, 1.0) : 1);
    const Row a(take.values.data() + before * width, width),
        b(take.values.data() + after * width, width);
    const Eigen::VectorXd value = ((1 - share) * a + share * b).cast<double>();
    result.inputs.col(frame) = value.head(take.inputs);
    result.outputs.col(frame) = value.tail(take.outputs);
  }
  return result;
}

}  // namespace gait
