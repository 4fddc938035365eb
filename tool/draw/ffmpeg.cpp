#include "draw/ffmpeg.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "gait/error.h"

namespace gait::tool {

namespace {

std::vector<std::string> arguments(const std::filesystem::path& film, int width, int height,
                                   double frame_rate) {
  std::array<char, 32> rate{};
  std::snprintf(rate.data(), rate.size(), "%.6f", frame_rate);
  return {"ffmpeg", "-hide_banner", "-loglevel", "error", "-nostdin", "-y",
          // what comes in
          "-f", "rawvideo", "-pixel_format", "bgr0", "-video_size",
          std::to_string(width) + "x" + std::to_string(height), "-framerate", rate.data(), "-i",
          "pipe:0",
          // what goes out: plays everywhere, no date or version inside
          "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-fflags", "+bitexact", "-flags:v",
          "+bitexact", "-map_metadata", "-1", "-f", "mp4",
          "file:" + std::filesystem::absolute(film).string()};
}

// The last line that says something.
std::string last_line(std::FILE* file) {
  std::rewind(file);
  std::string last, line;
  for (int c = std::fgetc(file);; c = std::fgetc(file)) {
    if (c != EOF && c != '\n' && c != '\r') {
      line += static_cast<char>(c);
      continue;
    }
    if (line.find_first_not_of(" \t") != std::string::npos) last = line;
    line.clear();
    if (c == EOF) return last;
  }
}

}  // namespace

Ffmpeg::Ffmpeg(const std::filesystem::path& film, int width, int height, double frame_rate)
    : bytes_(static_cast<std::size_t>(width) * height * 4), words_(std::tmpfile()) {
  std::array<int, 2> ends{};
  if (words_ == nullptr || pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error(std::string("cannot start ffmpeg: ") + std::strerror(errno));
  // A vanished ffmpeg must be an error, not the end of this program.
  std::signal(SIGPIPE, SIG_IGN);

  std::vector<std::string> words = arguments(film, width, height, frame_rate);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(words_.get()), STDERR_FILENO);
  const int failure = posix_spawnp(&process_, "ffmpeg", &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  pipe_ = ends[1];
  if (failure == 0) return;
  close(pipe_);
  pipe_ = -1;
  if (failure == ENOENT)
    throw Error("a film needs ffmpeg, which is not installed; .png and .svg do without");
  throw Error(std::string("cannot start ffmpeg: ") + std::strerror(failure));
}

Ffmpeg::~Ffmpeg() {
  if (pipe_ >= 0) close(pipe_);
  if (process_ > 0) {
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
  }
}

void Ffmpeg::add(const unsigned char* pixels) {
  for (std::size_t written = 0; written < bytes_;) {
    const ssize_t count = write(pipe_, pixels + written, bytes_ - written);
    if (count > 0)
      written += static_cast<std::size_t>(count);
    else if (errno != EINTR)
      fail();
  }
}

void Ffmpeg::finish() {
  close(std::exchange(pipe_, -1));
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail();
}

void Ffmpeg::fail() {
  // It may still be writing its last words.
  if (pipe_ >= 0) close(std::exchange(pipe_, -1));
  if (process_ > 0) waitpid(std::exchange(process_, -1), nullptr, 0);
  const std::string said = last_line(words_.get());
  throw Error("ffmpeg could not make the film: " + (said.empty() ? "it said nothing" : said));
}

}  // namespace gait::tool
