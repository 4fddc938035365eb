#include "pd/worker.h"

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <atomic>
#include <condition_variable>
#include <deque>
#include <list>
#include <mutex>
#include <thread>

#include "pd/ticker.h"

namespace gait::pd {

namespace {

constexpr double look_every = 5;  // ms

struct Job {
  std::function<void()> work, finish;
  std::atomic<bool> done{false};
};

}  // namespace

struct Worker::Inside {
  explicit Inside(int how_nice) : nice(how_nice) {}
  const int nice;
  std::mutex mutex;
  std::condition_variable wake;
  std::deque<std::shared_ptr<Job>> waiting;
  // Seen by Pd's thread alone.
  std::list<std::shared_ptr<Job>> pending;
  Ticker look{[this] { finish_done(); }};
  std::thread thread{[this] { work(); }};

  void work() {
#ifdef __linux__
    // Of this thread and those it makes.
    if (nice > 0) setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), nice);
#endif
    for (;;) {
      std::shared_ptr<Job> job;
      {
        std::unique_lock lock(mutex);
        wake.wait(lock, [this] { return !waiting.empty(); });
        job = std::move(waiting.front());
        waiting.pop_front();
      }
      job->work();
      job->work = nullptr;  // what it held is let go of here
      job->done.store(true, std::memory_order_release);
    }
  }

  void finish_done() {
    // In order: a model asked for later must not be overtaken by an earlier one.
    while (!pending.empty() && pending.front()->done.load(std::memory_order_acquire)) {
      const std::shared_ptr<Job> job = pending.front();
      pending.pop_front();
      job->finish();
    }
    if (!pending.empty()) look.after(look_every);
  }

  void submit(std::shared_ptr<Job> job) {
    {
      const std::lock_guard lock(mutex);
      waiting.push_back(std::move(job));
    }
    wake.notify_one();
  }
};

Worker::Worker(int nice) : inside_(new Inside(nice)) { inside_->thread.detach(); }

Worker& Worker::get() {
  static Worker* const worker = new Worker(0);
  return *worker;
}

Worker& Worker::patient() {
  static Worker* const worker = new Worker(10);
  return *worker;
}

void Worker::run(std::function<void()> work, std::function<void()> finish, bool blocking) {
  if (blocking) {
    work();
    finish();
    return;
  }
  auto job = std::make_shared<Job>();
  job->work = std::move(work);
  job->finish = std::move(finish);
  inside_->pending.push_back(job);
  inside_->submit(std::move(job));
  inside_->look.after(look_every);
}

void Worker::free_later(std::shared_ptr<const void> what) {
  auto job = std::make_shared<Job>();
  // Capturing it is all there is to do: the job is emptied by the worker.
  job->work = [held = std::move(what)] {};
  inside_->submit(std::move(job));
}

}  // namespace gait::pd
