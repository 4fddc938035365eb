// An ffmpeg process that is fed raw pictures and makes a film of them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "gait/platform/child_process.h"

namespace gait::tool {

class Ffmpeg {
 public:
  // Pictures of `width` x `height` pixels (both even), four bytes each, blue first. Throws Error
  // when ffmpeg is not there. When finish() is not reached, the process is ended.
  Ffmpeg(const std::filesystem::path& film, int width, int height, double frame_rate);

  void add(const unsigned char* pixels);  // throws Error when ffmpeg has gone
  void finish();                          // waits for it; throws Error with its last words

 private:
  [[noreturn]] void fail();

  std::size_t bytes_;
  std::unique_ptr<ChildProcess> process_;
};

}  // namespace gait::tool
