// Progress of long work: one line on stderr that overwrites itself. Silent unless stderr is a
// terminal.
#pragma once

#include <cstdio>
#include <string>

namespace gait::tool {

class Progress {
 public:
  // `what`: "gait render: drawing the film".
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
