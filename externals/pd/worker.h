// A thread for work that takes too long for Pd's thread. It does job after job; a clock on Pd's
// thread sees the end of each job and finishes it there. The worker never calls Pd.
#pragma once

#include <functional>
#include <memory>

namespace gait::pd {

class Worker {
 public:
  // Made when it is first needed and never destroyed: Pd leaves by exit(), and a thread in a static
  // object would end the process in disorder.
  static Worker& get();
  // Another worker for jobs of seconds: loading a model does not wait for them, and its low
  // priority gives way to sound.
  static Worker& patient();

  // `work` runs on the worker, then `finish` on Pd's thread; neither may throw. With `blocking`
  // both run on this thread before this returns: for batch patches, whose logical time runs ahead
  // of every other thread.
  void run(std::function<void()> work, std::function<void()> finish, bool blocking = false);

  // Releases something large on the worker, so that it is freed there.
  void free_later(std::shared_ptr<const void> what);

 private:
  explicit Worker(bool patient);
  struct Inside;
  Inside* inside_;
};

// Puts `next` in the place of `now`; the worker frees what was there.
template <class T>
void replace(std::shared_ptr<T>& now, std::shared_ptr<T> next) {
  now.swap(next);
  if (next) Worker::get().free_later(std::move(next));
}

}  // namespace gait::pd
