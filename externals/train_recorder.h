// Takes that [gait.train] records: in memory, and on disk while they are recorded.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "gait/teach/takes_file.h"

namespace gait::pd {

class TakeRecorder {
 public:
  using Takes = std::vector<std::shared_ptr<const RecordedTake>>;
  static constexpr double longest_take = 600;  // seconds
  static constexpr int most_frames = 72000;    // of a take: 600 s at 120 frames per second

  // `journal`: file that takes are written to. What an earlier session left there is
  // moved aside first; while another box or another Pd writes there, this one's is numbered
  // (NAME-2.takes). `blocking`: write at once instead of on the worker.
  TakeRecorder(const std::filesystem::path& journal, bool blocking);
  ~TakeRecorder();
  TakeRecorder(const TakeRecorder&) = delete;
  TakeRecorder& operator=(const TakeRecorder&) = delete;

  // The file with takes of an earlier session; empty when there is none.
  const std::string& left_behind() const { return left_behind_; }

  void start(const std::string& label, int inputs, int outputs);
  bool recording() const { return recording_ != nullptr; }
  // A frame at this time in seconds; false when the take is full. Frames without progress in time
  // replace the one before.
  bool add(double time, std::span<const float> inputs, std::span<const float> outputs);
  // Writes the frames that have come since it was called last, on the worker. To be called now and
  // then while it records.
  void save();
  // The take just ended; null when nothing was recorded.
  std::shared_ptr<const RecordedTake> stop();

  void add_take(RecordedTake take);
  void remove(int index);
  bool undo();  // takes the last change of the list back
  const Takes& takes() const { return takes_; }

 private:
  void change(Takes next);
  void save_until(int frames);
  // Writes a piece of a take on the worker; `begins`: its first one. `what` is all that it needs.
  void write(bool begins, std::function<void(std::ostream&)> what);

  // Opens and locks the file. Returns why it cannot: busy when another box or program has locked
  // it.
  std::error_code open_journal(const std::filesystem::path& path);

  std::string left_behind_;
  struct Journal;
  std::shared_ptr<Journal> journal_;  // the worker may still write
  bool blocking_;
  std::unique_ptr<RecordedTake> recording_;
  double begin_ = 0;
  int saved_ = -1;  // frames of the take on disk; -1: not even its first line
  Takes takes_;
  std::vector<Takes> before_;
};

// Where takes of this name are written: $XDG_STATE_HOME/gait/NAME.takes, else under
// ~/.local/state.
std::filesystem::path journal_path(const std::string& name);

}  // namespace gait::pd
