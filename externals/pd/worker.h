// What takes too long for Pd's thread: done on one worker thread, job after job; its end is seen by
// a clock on Pd's thread, which then finishes it there. The worker never calls Pd.
#pragma once

#include <functional>
#include <memory>

namespace gait::pd {

class Worker {
 public:
  // Made when it is first needed and never destroyed: Pd leaves by exit(), and a thread in a static
  // object would end the process in disorder.
  static Worker& get();
  // Another for what takes seconds, behind everybody else: nobody's model waits for it, and it
  // gives way to sound.
  static Worker& patient();

  // `work` runs on the worker, then `finish` on Pd's thread; neither may throw. With `blocking`
  // both run before this returns, on this thread: for batch patches, where logical time runs away
  // from everybody else.
  void run(std::function<void()> work, std::function<void()> finish, bool blocking = false);

  // Lets go of something large on the worker, once nobody else holds it.
  void free_later(std::shared_ptr<const void> what);

 private:
  explicit Worker(int nice);
  struct Inside;
  Inside* inside_;
};

}  // namespace gait::pd
