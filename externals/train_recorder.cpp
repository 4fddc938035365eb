#include "train_recorder.h"

#include <m_pd.h>

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

struct TakeRecorder::Journal {
  std::unique_ptr<LockedFile> file;
  std::string missing{};  // why there is no file

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
  recording_->values.shrink_to_fit();
  recording_->seconds.shrink_to_fit();
  const std::shared_ptr<const RecordedTake> take = std::move(recording_);
  Takes next = takes_;
  next.push_back(take);
  change(std::move(next));
  write(take);
  return take;
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

void TakeRecorder::write(const std::shared_ptr<const RecordedTake>& take) {
  const auto failed = std::make_shared<std::string>();
  Worker::get().run(
      [take, failed, journal = journal_] {
        if (!journal->file) {
          *failed = journal->missing;
          return;
        }
        std::ostringstream text;
        if (journal->file->size() == 0) write_takes_header(text);
        write_take(*take, text);
        if (const std::error_code failure = journal->file->append(text.str()))
          *failed = utf8_of(journal->file->path()) + ": " + failure.message();
      },
      [failed] {
        if (!failed->empty())
          pd_error(nullptr, "gait.train: a take could not be written to %s; it is kept in memory",
                   failed->c_str());
      },
      blocking_);
}

}  // namespace gait::pd
