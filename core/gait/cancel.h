// A request to stop long work in good order. std::stop_token would do, but libc++ before version 20
// has none.
#pragma once

#include <atomic>
#include <memory>

namespace gait {

// Copies share one flag: one is kept by who may ask, another by the work that looks.
class Cancel {
 public:
  void request() const noexcept { *flag_ = true; }
  bool requested() const noexcept { return *flag_; }

 private:
  std::shared_ptr<std::atomic<bool>> flag_ = std::make_shared<std::atomic<bool>>(false);
};

}  // namespace gait
