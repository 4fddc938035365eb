#include "walking_takes.h"

#include <filesystem>

#include "gait/corpus/corpus.h"
#include "gait/files/bvh.h"

namespace gait::testing {

void write_take(const std::string& path, const std::string& style, int take, int cycles,
                double frame_rate) {
  WalkPlan plan;
  plan.style = corpus_style(style);
  plan.cycles = cycles;
  plan.take = take;
  write_bvh(bvh_from_clip(make_walk(plan, frame_rate).clip), path);
}

std::string write_takes(const std::string& folder, int first, int last) {
  std::filesystem::create_directories(folder);
  for (const std::string style : {"proud", "sad"})
    for (int take = first; take <= last; ++take)
      write_take(folder + "/walk_" + style + "_" + std::to_string(take) + ".bvh", style, take);
  return folder;
}

ToolRun train_quickly(const std::vector<std::string>& clips, const std::string& model,
                      const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"train"};
  arguments.insert(arguments.end(), clips.begin(), clips.end());
  for (const char* word : {"-o", "", "--states", "3", "--regularisation", "30", "--rounds", "0"})
    arguments.push_back(*word == '\0' ? model : word);
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_tool(arguments);
}

}  // namespace gait::testing
