// Makes state tables for another set of inputs while the walk goes on (docs/design.md, Emissions):
// the player asks, a worker factors, the player takes the result between two frames.
//
// Only atomics between them; the player neither waits, allocates nor frees.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "gait/joining_thread.h"
#include "gait/play/recognise/state_tables.h"

namespace gait {

class TableMaker {
 public:
  explicit TableMaker(std::shared_ptr<const Model> model);
  ~TableMaker();

  // Asks for tables without the inputs marked in `missing` (one per input value). False when the
  // worker is still busy with the last request or its result was not taken yet: ask again later.
  bool ask(const std::vector<bool>& missing) noexcept;

  // The result, once it is there: then true, and `current` holds it. Tables that `current` held are
  // handed back for the worker to free; no other object may still use them.
  bool take(std::shared_ptr<const StateTables>& current) noexcept;

  // Whether the worker is done with the last request; it stays so until the result is taken.
  bool finished() const noexcept { return state_.load(std::memory_order_acquire) == done; }

  // Look at the result before it is taken, so that all its users can change over. Null: none, or
  // nothing could be made.
  std::shared_ptr<const StateTables> ready() const noexcept;

 private:
  enum State : int { idle, asked, done, returned, closing };

  void work();

  std::shared_ptr<const Model> model_;
  std::vector<bool> missing_;
  std::shared_ptr<const StateTables> tables_;  // whose it is, state_ says
  std::atomic<int> state_{idle};
  JoiningThread worker_;
};

}  // namespace gait
