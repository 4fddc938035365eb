// gait corpus: the built-in walks as files.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "commands.h"
#include "gait/corpus/corpus.h"
#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/files/label_file.h"
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

void write_walk(const CorpusWalk& walk, const std::filesystem::path& folder) {
  const std::filesystem::path bvh = folder / corpus_file_name(walk);
  write_bvh(bvh_from_clip(walk.clip), bvh);
  write_labels(labels_from_contacts(walk.contacts, walk.clip.frame_rate), LabelForm::audacity,
               std::filesystem::path(bvh).replace_extension(".txt"));
}

void corpus(const CorpusOptions& options) {
  const std::filesystem::path folder = options.folder;
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    throw Error(options.folder + ": expected a folder to write to: " + failure.message());

  std::vector<CorpusWalk> walks = make_corpus(options.seed);
  if (options.speeds)
    for (CorpusWalk& walk : make_speed_walks(options.seed)) walks.push_back(std::move(walk));
  std::map<std::string, StyleCount> styles;
  std::vector<std::string> order;
  {
    Progress progress("gait corpus: writing walks");
    for (std::size_t i = 0; i < walks.size(); ++i) {
      write_walk(walks[i], folder);
      const std::string& name = walks[i].style.empty() ? walks[i].subject : walks[i].style;
      if (!styles.contains(name)) order.push_back(name);
      StyleCount& style = styles[name];
      ++style.clips;
      style.cycles += static_cast<int>(cycles_between(walks[i].contacts).size());
      style.seconds += walks[i].clip.frames() / walks[i].clip.frame_rate;
      progress.show(static_cast<double>(i + 1) / static_cast<double>(walks.size()));
    }
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
