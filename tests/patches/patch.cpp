#include "patches/patch.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <thread>

namespace gait::testing {

namespace {

// In a patch's text commas, semicolons and dollars of a box are escaped.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == ',' || c == ';' || c == '$') result += std::string(result.empty() ? "" : " ") + "\\";
    result += c;
  }
  return result;
}

}  // namespace

Patch::Patch() { text_ = "#N canvas 0 0 700 700 12;\n"; }

void Patch::declare(const std::string& what) { text_ += "#X declare " + what + ";\n"; }

int Patch::add(const std::string& kind, const std::string& text) {
  text_ += "#X " + kind + " 10 " + std::to_string(10 + 20 * pieces_) + " " + escaped(text) + ";\n";
  return pieces_++;
}

int Patch::subpatch(const std::string& name) {
  text_ += "#N canvas 0 0 450 300 " + name + " 0;\n#X restore 10 10 pd " + name + ";\n";
  return pieces_++;
}

void Patch::connect(int from, int outlet, int to, int inlet) {
  cords_ += "#X connect " + std::to_string(from) + " " + std::to_string(outlet) + " " +
            std::to_string(to) + " " + std::to_string(inlet) + ";\n";
}

void Patch::at_start(const std::vector<std::string>& messages, int to, int inlet) {
  // [loadbang] fires its cords in the order they were made.
  const int begin = object("loadbang");
  for (const std::string& text : messages) {
    const int box = message(text);
    connect(begin, 0, box);
    connect(box, 0, to, inlet);
  }
}

void Patch::record(int from, int outlet, const std::string& name) {
  connect(from, outlet, object("recorder " + name));
}

void Patch::file(const std::string& name, const std::string& contents) {
  files_.emplace_back(name, contents);
}

void Patch::quit_after(double milliseconds) {
  const int begin = object("loadbang"), delay = object("delay " + std::to_string(milliseconds)),
            quit = message("; pd quit 0");
  connect(begin, 0, delay);
  connect(delay, 0, quit);
}

void Patch::dsp() {
  const int begin = object("loadbang"), on = message("; pd dsp 1");
  connect(begin, 0, on);
}

std::string Patch::whole() const { return text_ + cords_; }

std::string pd_program() {
  const char* const other = std::getenv("GAIT_PD_PROGRAM");
  return other != nullptr && *other != '\0' ? other : GAIT_PD_PROGRAM;
}

bool has_pd() { return pd_program().find("NOTFOUND") == std::string::npos; }

bool says(const std::vector<std::string>& lines, const std::string& line) {
  const auto same_word = [](const std::string& one, const std::string& other) {
    char *one_end = nullptr, *other_end = nullptr;
    const double a = std::strtod(one.c_str(), &one_end), b = std::strtod(other.c_str(), &other_end);
    const bool numbers = *one_end == '\0' && *other_end == '\0';
    return numbers ? std::abs(a - b) <= 1e-7 * (1 + std::abs(b)) : one == other;
  };
  const auto words_of = [](const std::string& text) {
    std::istringstream words(text);
    return std::vector<std::string>(std::istream_iterator<std::string>(words), {});
  };
  return std::ranges::any_of(lines, [&](const std::string& said) {
    return std::ranges::equal(words_of(said), words_of(line), same_word);
  });
}

bool can_watch() { return std::string(GAIT_PD_PRELOAD).empty(); }

int watched_allocations(const PdRun& run) {
  const std::size_t at = run.log.find("watch: ");
  return at == std::string::npos ? -1 : std::atoi(run.log.c_str() + at + 7);
}

PdRun run_pd(const Patch& patch, const RunOptions& options) {
  namespace fs = std::filesystem;
  PdRun run;
  std::string name = ::testing::TempDir() + "gait_patch_XXXXXX";
  run.folder = mkdtemp(name.data());
  std::ofstream(run.folder + "/test.pd") << patch.whole();
  const std::string library = options.home.empty() ? "-path '" GAIT_PD_FOLDER
                                                     "' -path '" GAIT_RECORDER_FOLDER
                                                     "' -lib recorder -lib gait"
                                                   : "";
  const std::string home = options.home.empty() ? "" : "HOME='" + options.home + "' ";
  for (const auto& [file, contents] : patch.files_)
    std::ofstream(run.folder + "/" + file) << contents;
  const std::string state =
      "XDG_STATE_HOME='" + (options.state.empty() ? run.folder : options.state) + "' ";
  const std::string command =
      "cd '" + run.folder + "' && " + home + state + std::string(GAIT_PD_PRELOAD) +
      (options.watched ? "LD_PRELOAD=" GAIT_ALLOCATION_WATCH : "") + " timeout " +
      std::to_string(options.at_most) + " " + pd_program() +
      " -nogui -noprefs -noaudio -nomidi -r 48000 -stderr " +
      (options.meanwhile ? "-sleepgrain 0.5 " : "-batch ") + library + " -open test.pd 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  std::thread world;
  if (options.meanwhile) world = std::thread([&, seen = run] { options.meanwhile(seen); });
  std::array<char, 4096> piece;
  while (const std::size_t count = fread(piece.data(), 1, piece.size(), pipe))
    run.log.append(piece.data(), count);
  if (world.joinable()) world.join();
  const int status = pclose(pipe);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return run;
}

PdRun run_undisturbed(const Patch& patch, double microseconds) {
  for (int again = 2;; --again) {
    PdRun run = run_pd(patch);
    double longest = 0;
    for (std::size_t at = run.log.find("ticks: "); at != std::string::npos;
         at = run.log.find("ticks: ", at + 1)) {
      double mean = 0, most = 0;
      if (std::sscanf(run.log.c_str() + at, "ticks: %lf %lf", &mean, &most) == 2)
        longest = std::max(longest, most);
    }
    if (longest <= microseconds || again == 0 || !can_watch()) return run;
  }
}

std::vector<std::string> PdRun::recorded(const std::string& name) const {
  std::vector<std::string> lines;
  std::ifstream file(folder + "/" + name);
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::vector<std::vector<double>> PdRun::numbers(const std::string& name,
                                                const std::string& selector) const {
  std::vector<std::vector<double>> rows;
  for (const std::string& line : recorded(name)) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    if (first != selector) continue;
    rows.emplace_back();
    for (double number; words >> number;) rows.back().push_back(number);
  }
  return rows;
}

bool PdRun::wait_for(const std::string& name, const std::string& beginning) const {
  for (int i = 0; i < 500; ++i) {
    for (const std::string& line : recorded(name))
      if (line.starts_with(beginning)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

int PdRun::process() const {
  namespace fs = std::filesystem;
  for (const auto& process : fs::directory_iterator("/proc")) {
    std::error_code unreadable;  // of others, or over by now
    if (fs::read_symlink(process.path() / "cwd", unreadable) != folder) continue;
    std::ifstream status(process.path() / "status");
    std::string line;
    if (std::getline(status, line) &&
        line == "Name:\t" + fs::path(pd_program()).filename().string())
      return std::stoi(process.path().filename());
  }
  return 0;
}

double PdRun::megabytes() const {
  std::ifstream status("/proc/" + std::to_string(process()) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) / 1000;
  return 0;
}

std::vector<std::string> PdRun::errors() const {
  static const std::regex failure(
      "couldn't create|^error:|^verbose\\(1\\):|no method for|bad arguments|can't open|undefined "
      "symbol|class '.*' overwritten|refusing to load|connection failed|ERROR: "
      "AddressSanitizer|ERROR: LeakSanitizer|runtime error|ThreadSanitizer");
  std::vector<std::string> found;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);)
    if (std::regex_search(line, failure)) found.push_back(line);
  return found;
}

}  // namespace gait::testing
