#include "gait/play/recognise/table_maker.h"

#include "gait/error.h"

namespace gait {

TableMaker::TableMaker(std::shared_ptr<const Model> model)
    : model_(std::move(model)), missing_(model_->input.values, false) {
  worker_ = JoiningThread([this] { work(); });
}

TableMaker::~TableMaker() {
  // Whatever the worker does now, it must see `closing` afterwards.
  int seen = state_.load();
  while (true) {
    if (seen == asked) {  // let it finish: its state change would overwrite ours
      state_.wait(asked);
      seen = state_.load();
      continue;
    }
    if (state_.compare_exchange_strong(seen, closing)) break;
  }
  state_.notify_all();
}

bool TableMaker::ask(const std::vector<bool>& missing) noexcept {
  if (state_.load(std::memory_order_acquire) != idle) return false;
  for (std::size_t i = 0; i < missing_.size(); ++i) missing_[i] = missing[i];
  state_.store(asked, std::memory_order_release);
  state_.notify_all();
  return true;
}

std::shared_ptr<const StateTables> TableMaker::ready() const noexcept {
  return state_.load(std::memory_order_acquire) == done ? tables_ : nullptr;
}

bool TableMaker::take(std::shared_ptr<const StateTables>& current) noexcept {
  if (state_.load(std::memory_order_acquire) != done) return false;
  const bool made = tables_ != nullptr;
  if (made) tables_.swap(current);
  state_.store(returned, std::memory_order_release);
  state_.notify_all();
  return made;
}

void TableMaker::work() {
  while (true) {
    const int state = state_.load(std::memory_order_acquire);
    if (state == closing) return;
    if (state == asked) {
      try {
        tables_ = make_state_tables(*model_, missing_);
      } catch (const Error&) {
        tables_.reset();  // nothing left to see: the old tables go on with held values
      }
      state_.store(done, std::memory_order_release);
      state_.notify_all();
    } else if (state == returned) {
      tables_.reset();
      int expected = returned;
      state_.compare_exchange_strong(expected, idle);
      state_.notify_all();
    } else {
      state_.wait(state);
    }
  }
}

}  // namespace gait
