#include "decision_table.h"

#include <cstdio>
#include <sstream>

#include "gait/platform/whole_file.h"

namespace gait::tool {

namespace {

// In quotes where commas, quotes or line ends ask for it (RFC 4180).
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

void write_decisions(const ReconstructedClip& walk, const Model& model,
                     const std::filesystem::path& path, int first_row) {
  std::ostringstream file;
  file << "time,step,state,log_likelihood,phase,cadence";
  for (const std::string& style : model.styles) file << ',' << csv_field("style " + style);
  file << '\n';
  for (std::size_t frame = 0; frame < walk.decisions.size(); ++frame) {
    const Decision& decision = walk.decisions[frame];
    char row[160];
    std::snprintf(row, sizeof row, ",%d,%.6g,%.6f,%.4f", decision.state,
                  static_cast<double>(decision.log_likelihood), static_cast<double>(decision.phase),
                  static_cast<double>(decision.cadence));
    char time[32];
    std::snprintf(time, sizeof time, "%.6f",
                  static_cast<double>(first_row + static_cast<int>(frame)) / walk.clip.frame_rate);
    file << time << ',' << csv_field(model.labels[decision.label].name) << row;
    for (Eigen::Index style = 0; style < walk.style_posteriors.rows(); ++style) {
      std::snprintf(
          row, sizeof row, ",%.6f",
          static_cast<double>(walk.style_posteriors(style, static_cast<Eigen::Index>(frame))));
      file << row;
    }
    file << '\n';
  }
  write_whole_file(path, file.str());
}

}  // namespace gait::tool
