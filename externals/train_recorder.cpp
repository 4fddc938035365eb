#include "train_recorder.h"

#include <fcntl.h>
#include <m_pd.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>

#include "gait/error.h"
#include "pd/worker.h"

namespace gait::pd {

namespace fs = std::filesystem;

std::string journal_path(const std::string& name) {
  fs::path folder;
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state != '\0')
    folder = state;
  else if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    folder = fs::path(home) / ".local" / "state";
  else
    folder = fs::temp_directory_path();
  std::string file;
  for (const char c : name) file += c == '/' || c == '\\' ? '_' : c;
  return (folder / "gait" / (file + ".takes")).string();
}

namespace {

RecordedTake piece_of(const RecordedTake& take, int from, int to) {
  const auto width = static_cast<std::ptrdiff_t>(take.inputs + take.outputs);
  RecordedTake piece{take.label, take.inputs, take.outputs, {}, {}};
  piece.seconds.assign(take.seconds.begin() + from, take.seconds.begin() + to);
  piece.values.assign(take.values.begin() + width * from, take.values.begin() + width * to);
  return piece;
}

}  // namespace

// Locked for as long as it is open.
struct TakeRecorder::Journal {
  std::string path;
  int file = -1;
  bool begun = false;

  explicit Journal(std::string at) : path(std::move(at)) {
    file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (file >= 0 && flock(file, LOCK_EX | LOCK_NB) != 0) {
      close(file);
      file = -1;
    }
  }
  ~Journal() {
    if (file < 0) return;
    std::error_code failure;
    if (!begun) fs::remove(path, failure);
    close(file);
  }
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
};

TakeRecorder::TakeRecorder(const std::string& journal, bool blocking) : blocking_(blocking) {
  std::error_code failure;
  fs::create_directories(fs::path(journal).parent_path(), failure);
  if (failure || open_journal(journal)) return;
  for (int number = 2; number < 100; ++number) {
    const fs::path path(journal);
    const std::string name =
        path.stem().string() + "-" + std::to_string(number) + path.extension().string();
    if (open_journal((path.parent_path() / name).string())) return;
  }
}

TakeRecorder::~TakeRecorder() = default;

bool TakeRecorder::open_journal(const std::string& path) {
  auto journal = std::make_shared<Journal>(path);
  if (journal->file < 0) return false;
  std::error_code failure;
  if (fs::file_size(path, failure) > 0 && !failure) {
    // The first free number: nothing is ever written over.
    std::string aside;
    for (int number = 1; aside.empty() || fs::exists(aside, failure); ++number)
      aside = path + "." + std::to_string(number);
    fs::rename(path, aside, failure);
    if (failure) return false;
    journal->begun = true;  // the file that is locked has another name now, and stays
    left_behind_ = aside;
    journal = std::make_shared<Journal>(path);
    if (journal->file < 0) return false;
  }
  journal_ = std::move(journal);
  return true;
}

void TakeRecorder::start(const std::string& label, int inputs, int outputs) {
  recording_ = std::make_unique<RecordedTake>();
  recording_->label = label;
  recording_->inputs = inputs;
  recording_->outputs = outputs;
  saved_ = -1;
  // Once, for the longest take: nothing is made at frame rate. The system gives it as it is used.
  recording_->seconds.reserve(most_frames);
  recording_->values.reserve(static_cast<std::size_t>(most_frames) *
                             static_cast<std::size_t>(inputs + outputs));
}

bool TakeRecorder::add(double time, std::span<const float> inputs, std::span<const float> outputs) {
  RecordedTake& take = *recording_;
  if (take.seconds.empty()) begin_ = time;
  const double since = time - begin_;
  if (take.frames() >= most_frames || since > longest_take) return false;
  if (!take.seconds.empty() && since <= take.seconds.back()) {
    take.seconds.pop_back();
    take.values.resize(take.values.size() - inputs.size() - outputs.size());
  }
  take.seconds.push_back(take.seconds.empty() ? 0 : since);
  take.values.insert(take.values.end(), inputs.begin(), inputs.end());
  take.values.insert(take.values.end(), outputs.begin(), outputs.end());
  return true;
}

std::shared_ptr<const RecordedTake> TakeRecorder::stop() {
  if (!recording_ || recording_->frames() == 0) {
    recording_.reset();
    return nullptr;
  }
  save_until(recording_->frames());
  write([](std::ostream& file) { write_take_end(file); });
  recording_->values.shrink_to_fit();
  recording_->seconds.shrink_to_fit();
  const std::shared_ptr<const RecordedTake> take = std::move(recording_);
  Takes next = takes_;
  next.push_back(take);
  change(std::move(next));
  return take;
}

// All but the last frame: another one at the same time may replace it.
void TakeRecorder::save() { save_until(recording_->frames() - 1); }

void TakeRecorder::save_until(int ready) {
  const RecordedTake& take = *recording_;
  if (ready <= std::max(0, saved_)) return;
  const bool first = saved_ < 0;
  const int from = std::max(0, saved_);
  write([piece = piece_of(take, from, ready), first](std::ostream& file) {
    if (first) write_take_begin(piece, file);
    write_frames(piece, file);
  });
  saved_ = ready;
}

void TakeRecorder::add_take(RecordedTake take) {
  Takes next = takes_;
  next.push_back(std::make_shared<const RecordedTake>(std::move(take)));
  change(std::move(next));
}

void TakeRecorder::remove(int index) {
  Takes next = takes_;
  next.erase(next.begin() + index);
  change(std::move(next));
}

bool TakeRecorder::undo() {
  if (before_.empty()) return false;
  takes_ = std::move(before_.back());
  before_.pop_back();
  return true;
}

void TakeRecorder::change(Takes next) {
  before_.push_back(std::move(takes_));
  takes_ = std::move(next);
}

void TakeRecorder::write(std::function<void(std::ostream&)> what) {
  const auto failed = std::make_shared<bool>(false);
  Worker::get().run(
      [what = std::move(what), failed, journal = journal_] {
        *failed = true;
        if (!journal) return;
        std::ofstream file(journal->path, std::ios::app);
        if (!std::exchange(journal->begun, true)) write_takes_header(file);
        what(file);
        file.flush();
        *failed = !file;
      },
      [failed, journal = journal_] {
        if (*failed)
          pd_error(nullptr, "gait.train: a take could not be written to %s; it is kept in memory",
                   journal ? journal->path.c_str() : "a journal");
      },
      blocking_);
}

}  // namespace gait::pd
