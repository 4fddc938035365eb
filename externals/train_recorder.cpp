#include "train_recorder.h"

#include <m_pd.h>

#include <algorithm>
#include <sstream>
#include <system_error>
#include <utility>

#include "gait/platform/host_process.h"
#include "gait/platform/locked_file.h"
#include "gait/platform/path_text.h"
#include "pd/worker.h"

namespace gait::pd {

namespace fs = std::filesystem;

fs::path journal_path(const std::string& name) {
  std::string file;
  for (const char c : name) file += c == '/' || c == '\\' ? '_' : c;
  return state_folder() / "gait" / path_from_utf8(file + ".takes");
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

struct TakeRecorder::Journal {
  std::unique_ptr<LockedFile> file;
  std::string missing{};  // why there is no file
  // The worker's: a piece of the take could not be written. Without it, those after it would be no
  // take, so they are left out.
  bool lost = false;

  ~Journal() {
    if (file && file->size() == 0) file->remove();
  }
};

TakeRecorder::TakeRecorder(const fs::path& journal, bool blocking)
    : journal_(std::make_shared<Journal>()), blocking_(blocking) {
  std::error_code failure;
  fs::create_directories(journal.parent_path(), failure);
  fs::path path = journal;
  for (int number = 2; !failure && number < 100; ++number) {
    failure = open_journal(path);
    if (!failure) return;
    if (failure != std::errc::device_or_resource_busy) break;
    failure.clear();
    path = journal.parent_path() / journal.stem();
    path += "-" + std::to_string(number);
    path += journal.extension();
  }
  journal_->missing = utf8_of(path) + ": " + (failure ? failure.message() : "taken");
}

TakeRecorder::~TakeRecorder() = default;

std::error_code TakeRecorder::open_journal(const fs::path& path) {
  std::error_code failure;
  auto file = LockedFile::open(path, failure);
  if (file && file->size() > 0) {
    // The first free number: nothing is ever written over.
    fs::path aside;
    for (int number = 1; aside.empty() || fs::exists(aside, failure); ++number)
      (aside = path) += "." + std::to_string(number);
    failure = file->rename(aside);
    if (failure) return failure;
    left_behind_ = utf8_of(aside);
    file = LockedFile::open(path, failure);
  }
  if (file) journal_->file = std::move(file);
  return failure;
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
  write(false, [](std::ostream& file) { write_take_end(file); });
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
  write(first, [piece = piece_of(take, from, ready), first](std::ostream& file) {
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

void TakeRecorder::write(bool begins, std::function<void(std::ostream&)> what) {
  const auto failed = std::make_shared<std::string>();
  Worker::get().run(
      [begins, what = std::move(what), failed, journal = journal_] {
        if (!begins && journal->lost) return;
        journal->lost = true;
        if (!journal->file) {
          *failed = journal->missing;
          return;
        }
        std::ostringstream text;
        if (journal->file->size() == 0) write_takes_header(text);
        what(text);
        if (const std::error_code failure = journal->file->append(text.str()))
          *failed = utf8_of(journal->file->path()) + ": " + failure.message();
        else
          journal->lost = false;
      },
      [failed] {
        if (!failed->empty())
          pd_error(nullptr, "gait.train: a take could not be written to %s; it is kept in memory",
                   failed->c_str());
      },
      blocking_);
}

}  // namespace gait::pd
