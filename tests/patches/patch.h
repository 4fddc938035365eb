// Patches made by tests and run in Pd itself, without a window and, unless asked, without waiting
// for time to pass.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace gait::testing {

struct PdRun;
struct RunOptions;

// The text of a patch. Each piece gets a number, from 0; pieces are connected by number.
class Patch {
 public:
  Patch();
  // The patch's own [declare]: what it needs from where Pd itself looks.
  void declare(const std::string& what);

  int object(const std::string& text) { return add("obj", text); }
  int message(const std::string& text) { return add("msg", text); }
  // An empty canvas of this name: `; pd-NAME obj ...` fills it.
  int subpatch(const std::string& name);
  void connect(int from, int outlet, int to, int inlet = 0);
  // Sends these messages to `to`, in this order, when the patch is loaded. `;` in them is Pd's.
  void at_start(const std::vector<std::string>& messages, int to, int inlet = 0);
  // Records what an outlet sends, each message a line; see PdRun::recorded.
  void record(int from, int outlet, const std::string& name);
  // A file beside the patch.
  void file(const std::string& name, const std::string& contents);
  // The patch ends itself after so many milliseconds of its own time, all loading done.
  void quit_after(double milliseconds);
  // Switches DSP on when the patch is loaded.
  void dsp();

  std::string whole() const;  // the file's text

 private:
  int add(const std::string& kind, const std::string& text);
  int pieces_ = 0;
  std::string text_, cords_;
  std::vector<std::pair<std::string, std::string>> files_;
  friend PdRun run_pd(const Patch& patch, const RunOptions& options);
};

struct PdRun {
  int exit_code = 0;   // 0 when the patch ended itself; 124: it did not end
  std::string log;     // Pd's console
  std::string folder;  // with what was recorded
  // Lines of a record: selector and arguments.
  std::vector<std::string> recorded(const std::string& name) const;
  // The numbers of the lines with this selector.
  std::vector<std::vector<double>> numbers(const std::string& name,
                                           const std::string& selector) const;
  // Waits until the record has a line that begins so; false when five seconds have passed.
  bool wait_for(const std::string& name, const std::string& beginning) const;
  // Pd's process while it runs, and the memory that it has in use, in MB; 0 when it does not run.
  int process() const;
  double megabytes() const;
  // Lines of the log that mean a failure (pd-notes: they do not show in the exit code).
  std::vector<std::string> errors() const;
};

// Whether one of these lines is `line`, numbers compared as single precision: Pd with 64-bit floats
// writes more digits of them.
bool says(const std::vector<std::string>& lines, const std::string& line);

// Whether allocations can be watched here: a sanitizer has an allocator of its own.
bool can_watch();
// How many there were; -1 when nothing was watched.
int watched_allocations(const PdRun& run);

// The Pd that patches are run in: what the environment variable GAIT_PD_PROGRAM names, or the `pd`
// that was found when the tests were configured.
std::string pd_program();
bool has_pd();
struct RunOptions {
  std::string home{};    // Pd sees only what is installed there; empty: the library just built
  std::string state{};   // folder for what objects keep between sessions; empty: the run's own
  bool watched = false;  // what is allocated between [watch]'s 1 and 0 is counted
  // Given: time passes in Pd as on stage, and this is what the world does meanwhile, on a thread of
  // its own; Pd's console is not there yet.
  std::function<void(const PdRun&)> meanwhile{};
  double at_most = 120;  // seconds until Pd is ended from outside
};
PdRun run_pd(const Patch& patch, const RunOptions& options = {});
// Runs it again, three times at most, while [ticks~] tells of a tick longer than this: what else
// the machine does shows there too, and is not there every time.
PdRun run_undisturbed(const Patch& patch, double microseconds);

}  // namespace gait::testing

// At the beginning of a test that runs Pd.
#define GAIT_NEEDS_PD() \
  if (!::gait::testing::has_pd()) GTEST_SKIP() << "there is no pd here (Debian: puredata-core)"
