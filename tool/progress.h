// Progress of long work: one line on stderr that overwrites itself, only where somebody watches.
#pragma once

#include <cstdio>
#include <string>

namespace gait::tool {

class Progress {
 public:
  // `what`: "gait render: drawing the film". Silent when stderr is not a terminal.
  explicit Progress(std::string what);
  ~Progress();  // wipes the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `share` of the work done, 0 to 1; `detail` may say more ("fold 2 of 5").
  void show(double share, const std::string& detail = "");

 private:
  std::string what_;
  std::string last_;
  bool watched_;
};

}  // namespace gait::tool
