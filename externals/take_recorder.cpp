#include "take_recorder.h"

#include <m_pd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

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

TakeRecorder::TakeRecorder(std::string journal, bool blocking)
    : journal_(std::move(journal)), blocking_(blocking) {
  std::error_code failure;
  if (!fs::exists(journal_, failure)) return;
  // The newest stays beside the new one; those before it are numbered.
  for (int number = 1; number < 1000; ++number) {
    const std::string aside = journal_ + "." + std::to_string(number);
    if (fs::exists(aside, failure)) continue;
    fs::rename(journal_, aside, failure);
    if (!failure) left_behind_ = aside;
    return;
  }
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
  const bool first = !begun_;
  begun_ = true;
  const auto reason = std::make_shared<std::string>();
  Worker::get().run(
      [take, first, reason, path = journal_] {
        std::error_code failure;
        fs::create_directories(fs::path(path).parent_path(), failure);
        std::ofstream file(path, first ? std::ios::trunc : std::ios::app);
        if (first) write_takes_header(file);
        write_take(*take, file);
        file.flush();
        if (!file) *reason = path;
      },
      [reason] {
        if (!reason->empty())
          pd_error(nullptr, "gait.train: a take could not be written to %s; it is kept in memory",
                   reason->c_str());
      },
      blocking_);
}

}  // namespace gait::pd
