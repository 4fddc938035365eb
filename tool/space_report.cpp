#include "space_report.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "gait/judge/space_summary.h"
#include "gait/judge/stream_summary.h"

namespace gait::tool {

namespace {

using nlohmann::ordered_json;

int percent(double share) { return static_cast<int>(std::lround(100 * share)); }

void print_row(const std::string& name, const SpaceSummary& summary) {
  std::printf("  %-20.20s %6d %5d", name.c_str(), summary.cycles, summary.kept);
  for (std::size_t i = 0; i < told_shares.size(); ++i)
    std::printf("  %4d (%5.1f)", summary.components[i], summary.reduction[i]);
  std::printf("\n");
}

void print_laws(const Model& model) {
  std::printf("Frequency over speed, a V^b cycles/s (V: leg lengths/s; Inman: 0.743 V^0.5)\n");
  std::printf("  %-20s %7s %7s %8s %13s\n", "subject", "a", "b", "leg, m", "V captured");
  for (const SpeedSpace& subject : model.speed_spaces)
    std::printf("  %-20.20s %7.3f %7.3f %8.3f %6.2f - %.2f\n", subject.subject.c_str(),
                subject.frequency_scale, subject.frequency_power, subject.leg_length,
                subject.slowest, subject.fastest);
}

ordered_json as_json(const CycleSpace& space, const SpaceSummary& summary) {
  ordered_json carried = ordered_json::array();
  for (std::size_t i = 0; i < told_shares.size(); ++i)
    carried.push_back({{"percent", percent(told_shares[i])},
                       {"components", summary.components[i]},
                       {"reduction", summary.reduction[i]}});
  return {{"cycles", summary.cycles},
          {"frames", space.frames},
          {"values", space.values()},
          {"kept", summary.kept},
          {"carried", carried}};
}

}  // namespace

void print_spaces(const Model& model) {
  std::printf(
      "\nWalks by itself step by step: %s; in styles: %s; at any speed: %s\n",
      has_trajectories(model) ? "yes" : "no", model.style_space ? "yes" : "no",
      model.speed_spaces.empty() ? "no (it takes somebody's walks at several speeds)" : "yes");
  if (!model.style_space && model.speed_spaces.empty()) return;
  std::printf("Components that carry a share of the variance (in brackets: cycles over them)\n");
  std::printf("  %-20s %6s %5s", "space", "cycles", "kept");
  for (const double share : told_shares) std::printf("  %9d %%", percent(share));
  std::printf("\n");
  if (model.style_space) print_row("styles", summary_of(*model.style_space));
  for (const SpeedSpace& subject : model.speed_spaces)
    print_row("speeds of " + subject.subject, summary_of(subject));
  if (!model.speed_spaces.empty()) print_laws(model);
}

ordered_json spaces_as_json(const Model& model) {
  ordered_json styles = nullptr, speeds = ordered_json::array();
  if (model.style_space) {
    styles = as_json(model.style_space->space, summary_of(*model.style_space));
    styles["cycles_per_style"] = model.style_space->cycles_per_style;
  }
  for (const SpeedSpace& subject : model.speed_spaces) {
    ordered_json entry{{"subject", subject.subject},
                       {"leg_length", subject.leg_length},
                       {"slowest", subject.slowest},
                       {"fastest", subject.fastest},
                       {"frequency_scale", subject.frequency_scale},
                       {"frequency_power", subject.frequency_power}};
    entry.update(as_json(subject.space, summary_of(subject)));
    speeds.push_back(entry);
  }
  return {{"steps", has_trajectories(model)}, {"styles", styles}, {"speeds", speeds}};
}

}  // namespace gait::tool
