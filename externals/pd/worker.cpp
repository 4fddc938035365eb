#include "pd/worker.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <list>
#include <mutex>
#include <thread>

#include "gait/platform/host_process.h"
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
  explicit Inside(bool gives_way) : patient(gives_way) {}
  const bool patient;
  std::mutex mutex;
  std::condition_variable wake;
  std::deque<std::shared_ptr<Job>> waiting;
  // Seen by Pd's thread alone.
  std::list<std::shared_ptr<Job>> pending;
  Ticker look{[this] { finish_done(); }};
  std::thread thread{[this] { work(); }};

  void work() {
    if (patient) give_way();
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

Worker::Worker(bool patient) : inside_(new Inside(patient)) { inside_->thread.detach(); }

Worker& Worker::get() {
  static Worker* const worker = new Worker(false);
  return *worker;
}

Worker& Worker::patient() {
  static Worker* const worker = new Worker(true);
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
