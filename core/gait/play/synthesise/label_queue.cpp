#include "gait/play/synthesise/label_queue.h"

#include <algorithm>

#include "gait/error.h"

namespace gait {

LabelQueue::LabelQueue(const std::vector<std::vector<int>>& successors)
    : labels_(static_cast<int>(successors.size())),
      towards_(successors.size() * successors.size(), none),
      follows_(successors.size(), none),
      before_(successors.size(), none) {
  if (successors.empty()) throw Error("expected at least one label to walk through; found none");
  for (int goal = 0; goal < labels_; ++goal) {
    // Breadth first from the goal backwards: who may be followed by it, who by those, and so on.
    std::vector<int> frontier{goal};
    while (!frontier.empty()) {
      std::vector<int> further;
      for (const int next : frontier)
        for (int label = 0; label < labels_; ++label) {
          int& way = towards_[static_cast<std::size_t>(label * labels_ + goal)];
          if (way != none || !std::ranges::count(successors[label], next)) continue;
          way = next;
          further.push_back(label);
        }
      frontier = std::move(further);
    }
  }
  for (int label = 0; label < labels_; ++label) {
    if (successors[label].empty()) continue;
    follows_[label] = successors[label].front();
    if (before_[follows_[label]] == none) before_[follows_[label]] = label;
  }
  for (int label = 0; label < labels_; ++label)
    for (const int next : successors[label])
      if (before_[next] == none) before_[next] = label;
}

int LabelQueue::way(int from, int goal) const noexcept {
  return from == none ? goal : towards_[static_cast<std::size_t>(from * labels_ + goal)];
}

bool LabelQueue::push(int label, int current) noexcept {
  if (label < 0 || label >= labels_ || count_ == capacity) return false;
  const int last = count_ > 0 ? queued_[(first_ + count_ - 1) % capacity] : current;
  if (way(last, label) == none) return false;
  queued_[(first_ + count_++) % capacity] = label;
  return true;
}

int LabelQueue::peek(int current) const noexcept {
  if (count_ > 0) return way(current, queued_[first_]);
  if (!auto_) return none;
  return current == none ? 0 : follows_[current];
}

int LabelQueue::take(int current) noexcept {
  const int next = peek(current);
  if (count_ > 0 && next == queued_[first_]) {
    first_ = (first_ + 1) % capacity;
    --count_;
  }
  return next;
}

}  // namespace gait
