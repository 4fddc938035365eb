// Work on the worker for a box that may be deleted before the work ends.
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "pd/worker.h"

namespace gait::pd {

// A member of the box: its end is the end of the box.
class Background {
 public:
  using Failed = std::function<void(const std::string& reason)>;

  // All work is done at once, on the thread that asks for it.
  void set_blocking(bool blocking) { blocking_ = blocking; }
  bool blocking() const { return blocking_; }

  // Runs `work` on the worker, which must hold copies of all it needs. Then, on Pd's thread and
  // only while the box is there, calls `done` with the result, or `failed` with the text of what
  // `work` threw.
  template <class Work, class Done>
  void run(Work work, Done done, Failed failed, Worker& worker = Worker::get()) {
    struct Outcome {
      std::optional<std::invoke_result_t<Work>> result;
      std::string reason;
    };
    const auto outcome = std::make_shared<Outcome>();
    worker.run(
        [outcome, work = std::move(work)]() mutable {
          try {
            outcome->result = work();
          } catch (const std::exception& error) {
            outcome->reason = error.what();
          }
        },
        while_here([outcome, done = std::move(done), failed = std::move(failed)] {
          if (outcome->result)
            done(std::move(*outcome->result));
          else
            failed(outcome->reason);
        }),
        blocking_);
  }

  // A function that does the same as `call` while the box is there, and nothing afterwards.
  template <class Call>
  auto while_here(Call call) const {
    return
        [here = std::weak_ptr<const bool>(here_), call = std::move(call)](const auto&... values) {
          if (!here.expired()) call(values...);
        };
  }

 private:
  bool blocking_ = false;
  std::shared_ptr<const bool> here_ = std::make_shared<const bool>(true);
};

}  // namespace gait::pd
