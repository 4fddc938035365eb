// gait corpus: the built-in walks as files.
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "gait/corpus/corpus.h"
#include "gait/platform/path_text.h"
#include "json_report.h"
#include "option_kinds.h"
#include "progress.h"

namespace gait::tool {

namespace {

struct CorpusOptions {
  std::string folder;
  std::uint64_t seed = 1;
  bool speeds = false, json = false;
};

struct StyleCount {
  int clips = 0, cycles = 0;
  double seconds = 0;
};

void corpus(const CorpusOptions& options) {
  std::vector<CorpusWalk> walks = make_corpus(options.seed);
  if (options.speeds)
    for (CorpusWalk& walk : make_speed_walks(options.seed)) walks.push_back(std::move(walk));
  {
    Progress progress("gait corpus: writing walks");
    write_corpus(path_from_utf8(options.folder), walks, 1,
                 [&](double share) { progress.show(share); });
  }
  std::map<std::string, StyleCount> styles;
  std::vector<std::string> order;
  for (const CorpusWalk& walk : walks) {
    const std::string& name = walk.style.empty() ? walk.subject : walk.style;
    if (!styles.contains(name)) order.push_back(name);
    StyleCount& style = styles[name];
    ++style.clips;
    style.cycles += static_cast<int>(cycles_between(walk.contacts).size());
    style.seconds += walk.clip.frames() / walk.clip.frame_rate;
  }

  if (options.json) {
    nlohmann::ordered_json report{{"folder", options.folder},
                                  {"seed", options.seed},
                                  {"notice", corpus_notice},
                                  {"styles", nlohmann::ordered_json::array()}};
    for (const std::string& style : order)
      report["styles"].push_back({{"style", style},
                                  {"clips", styles[style].clips},
                                  {"cycles", styles[style].cycles},
                                  {"seconds", styles[style].seconds}});
    print_report(report);
    return;
  }
  std::printf("%-16s %6s %7s %9s\n", "style", "clips", "cycles", "seconds");
  for (const std::string& style : order)
    std::printf("%-16s %6d %7d %9.1f\n", style.c_str(), styles[style].clips, styles[style].cycles,
                styles[style].seconds);
  std::printf("%zu clips with their labels in %s: %s\n", walks.size(), options.folder.c_str(),
              std::string(corpus_notice).c_str());
}

void add_options(CLI::App& app, CorpusOptions& options) {
  add_argument(app, "DIR", options.folder, "Folder to write to, made when missing");
  add_value(app, "--seed", "N", options.seed, "The same seed gives the same walks")
      ->check(seed_check());
  app.add_flag("--speeds", options.speeds,
               "Write the neutral walk at 0.6 to 2.0 m/s as well: walk_neutral_SPEED.bvh");
  add_json_flag(app, options.json);
  app.footer(
      R"(Each walk_STYLE_TAKE.bvh comes with walk_STYLE_TAKE.txt, its exact contacts in Audacity's
label form.

Examples:
  gait corpus walks
  gait corpus walks --speeds
  gait render walks/walk_*_1.bvh -o styles.png)");
}

}  // namespace

Command corpus_command(CLI::App& program) {
  return make_command(program, "corpus",
                      "Write the built-in synthetic walks: eleven styles, BVH and labels",
                      add_options, corpus);
}

}  // namespace gait::tool
