// What a box's frames cost: for `perf` and [gait.panel].
#pragma once

#include <algorithm>
#include <chrono>

#include "pd/outlet.h"

namespace gait::pd {

class Perf {
 public:
  // Measures one frame, from construction to the end of its scope.
  class Frame {
   public:
    explicit Frame(Perf& perf) : perf_(perf), begin_(std::chrono::steady_clock::now()) {}
    ~Frame() {
      if (forgotten_) return;
      const std::chrono::duration<double, std::micro> took =
          std::chrono::steady_clock::now() - begin_;
      perf_.sum_ += took.count();
      perf_.most_ = std::max(perf_.most_, took.count());
      ++perf_.frames_;
    }
    // Does not count this frame: none was due, or it was refused.
    void forget() { forgotten_ = true; }
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;

   private:
    Perf& perf_;
    std::chrono::steady_clock::time_point begin_;
    bool forgotten_ = false;
  };

  void drop() { ++dropped_; }

  // `perf MEAN_US MAX_US FRAMES DROPPED`, since the last time it was asked.
  void report(Outlet& info) {
    info.add(frames_ > 0 ? sum_ / frames_ : 0).add(most_).add(frames_).add(dropped_).send("perf");
    *this = {};
  }

 private:
  double sum_ = 0, most_ = 0;  // microseconds
  int frames_ = 0, dropped_ = 0;
};

}  // namespace gait::pd
