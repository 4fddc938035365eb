// An ffmpeg process that is fed raw pictures and makes a film of them. Started without a shell.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace gait::tool {

class Ffmpeg {
 public:
  // Pictures of `width` x `height` pixels (both even), four bytes each, blue first. Throws Error
  // when ffmpeg is not there.
  Ffmpeg(const std::filesystem::path& film, int width, int height, double frame_rate);
  ~Ffmpeg();  // ends the process when finish() was not reached
  Ffmpeg(const Ffmpeg&) = delete;
  Ffmpeg& operator=(const Ffmpeg&) = delete;

  void add(const unsigned char* pixels);  // throws Error when ffmpeg has gone
  void finish();                          // waits for it; throws Error with its last words

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[noreturn]] void fail();

  std::size_t bytes_;
  std::unique_ptr<std::FILE, Close> words_;  // its stderr
  pid_t process_ = -1;
  int pipe_ = -1;
};

}  // namespace gait::tool
