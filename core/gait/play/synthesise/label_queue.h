// The queue of labels that a walker goes through (MAGE's reactive control): first the labels that
// the performer queued, then, while that is on, the first successor of each label.
//
// Before a label that may not follow the one before it, the labels between them are walked, so that
// no walker takes two right steps in a row. Nothing allocates after construction.
#pragma once

#include <array>
#include <vector>

namespace gait {

class LabelQueue {
 public:
  static constexpr int capacity = 64;
  static constexpr int none = -1;

  // `successors`: per label those that may follow it. Throws Error when there are no labels.
  explicit LabelQueue(const std::vector<std::vector<int>>& successors);

  // False, with nothing changed, when there is no such label, when it can never be reached from the
  // last one queued (from `current`, when none is), or when the queue is full.
  bool push(int label, int current) noexcept;
  void clear() noexcept { count_ = 0; }
  int size() const noexcept { return count_; }
  // Whether labels follow by themselves when none is queued: the first of the successors.
  void set_auto(bool on) noexcept { auto_ = on; }

  // What follows `current` (none: what comes first); none: nothing does, for now.
  int peek(int current) const noexcept;
  int take(int current) noexcept;

  // The label that leads to `label` by itself: the first whose first successor it is, else any that
  // it may follow, else none.
  int before(int label) const noexcept { return before_[label]; }

 private:
  int way(int from, int goal) const noexcept;

  int labels_;
  std::vector<int> towards_;  // [current * labels + goal]: the next label on the shortest way
  std::vector<int> follows_, before_;  // by itself
  std::array<int, capacity> queued_{};
  int first_ = 0, count_ = 0;
  bool auto_ = true;
};

}  // namespace gait
