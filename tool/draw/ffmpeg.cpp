#include "draw/ffmpeg.h"

#include <array>
#include <cstdio>
#include <string>
#include <system_error>
#include <vector>

#include "gait/error.h"
#include "gait/platform/path_text.h"

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
          "file:" + utf8_of(std::filesystem::absolute(film))};
}

}  // namespace

Ffmpeg::Ffmpeg(const std::filesystem::path& film, int width, int height, double frame_rate)
    : bytes_(static_cast<std::size_t>(width) * height * 4) {
  std::error_code failure;
  process_ = ChildProcess::start(arguments(film, width, height, frame_rate), failure);
  if (failure == std::errc::no_such_file_or_directory)
    throw Error("a film needs ffmpeg, which is not installed; .png and .svg do without");
  if (!process_) throw Error("cannot start ffmpeg: " + failure.message());
}

void Ffmpeg::add(const unsigned char* pixels) {
  if (!process_->feed({pixels, bytes_})) fail();
}

void Ffmpeg::finish() {
  if (!process_->finish()) fail();
}

void Ffmpeg::fail() {
  process_->finish();  // it may still be writing its last words
  const std::string said = process_->last_words();
  throw Error("ffmpeg could not make the film: " + (said.empty() ? "it said nothing" : said));
}

}  // namespace gait::tool
