// What `gait train` says when it is done: what became of each clip, what was chosen, how good it
// is.
#pragma once

#include <string>

#include "gait/teach/walk_model.h"
#include "walk_files.h"

namespace gait::tool {

struct TrainReport {
  const WalksRead& read;
  const WalkSequences& walks;
  const Selected& selected;
  std::string output;  // the model's path
  double seconds = 0;  // all of it took
  int threads = 0;
};

void print_table(const TrainReport& report);
void print_json(const TrainReport& report);

}  // namespace gait::tool
