#include "patches/screen.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace gait::testing {

namespace {

constexpr auto look_every = std::chrono::milliseconds(200);
constexpr int looks = 150;

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Runs a command of the shell, which it replaces, so that the number is the program's own; in a
// group of its own, with the programs it starts.
pid_t start(const std::string& command) {
  const pid_t child = fork();
  if (child != 0) return child;
  setpgid(0, 0);
  execl("/bin/sh", "sh", "-c", ("exec " + command).c_str(), nullptr);
  _exit(127);
}

void stop(pid_t child) {
  if (child <= 0) return;
  kill(-child, SIGTERM);
  waitpid(child, nullptr, 0);
}

// XWD files (X11/XWDFile.h): a header of 32-bit numbers, high byte first, then the colour map and
// the rows.
std::uint32_t word(const std::string& dump, std::size_t index) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(dump[4 * index + i]);
  return value;
}

}  // namespace

bool has_screen() {
  return has_pd() && std::string(GAIT_XVFB).find("NOTFOUND") == std::string::npos &&
         std::system("command -v wish >/dev/null 2>&1") == 0;
}

Screen::Screen(const Patch& patch) {
  std::string name = ::testing::TempDir() + "gait_screen_XXXXXX";
  folder_ = mkdtemp(name.data());
  std::ofstream(folder_ + "/test.pd") << patch.whole();
  display_ = start(GAIT_XVFB " -displayfd 3 -screen 0 900x700x24 -fbdir '" + folder_ + "' 3>'" +
                   folder_ + "/display' 2>/dev/null");
  std::string display;
  for (int look = 0; look < looks && !display.ends_with('\n'); ++look) {
    std::this_thread::sleep_for(look_every);
    display = contents(folder_ + "/display");
  }
  if (!display.ends_with('\n')) return;  // nothing will be seen
  display.pop_back();
  pd_ = start("env DISPLAY=:" + display + " " GAIT_PD_PRELOAD " " + pd_program() +
              " -noprefs -noaudio -nomidi -stderr -path '" GAIT_PD_FOLDER "' -lib gait -open '" +
              folder_ + "/test.pd' >'" + folder_ + "/log' 2>&1");
}

Screen::~Screen() {
  stop(pd_);
  stop(display_);
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string Screen::log() const { return contents(folder_ + "/log"); }

int Screen::dots(std::array<int, 3> colour) const {
  const std::string dump = contents(folder_ + "/Xvfb_screen0");
  constexpr std::size_t header_words = 25;
  if (dump.size() < 4 * header_words) return 0;
  const std::size_t header = word(dump, 0), width = word(dump, 4), height = word(dump, 5),
                    row = word(dump, 12), colours = word(dump, 19);
  const bool low_byte_first = word(dump, 7) == 0;
  const std::size_t begin = header + 12 * colours;
  if (word(dump, 11) != 32 || dump.size() < begin + row * height) return 0;
  int count = 0;
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const auto* dot =
          reinterpret_cast<const unsigned char*>(dump.data()) + begin + y * row + 4 * x;
      const std::array<int, 3> here = low_byte_first ? std::array<int, 3>{dot[2], dot[1], dot[0]}
                                                     : std::array<int, 3>{dot[1], dot[2], dot[3]};
      count += here == colour ? 1 : 0;
    }
  return count;
}

int Screen::wait_for_dots(std::array<int, 3> colour, int least) const {
  int count = 0;
  for (int look = 0; look < looks && count < least; ++look) {
    std::this_thread::sleep_for(look_every);
    count = dots(colour);
  }
  return count;
}

}  // namespace gait::testing
