// The programs that [gait.osc] sends bodies to.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gait/osc/body_sender.h"
#include "pd/outlet.h"

namespace gait::pd {

class OscReceivers {
 public:
  explicit OscReceivers(Box& box) : box_(box) {}
  // Names are looked up at once, on this thread.
  void set_blocking() noexcept { blocking_ = true; }

  // `to HOST PORT FORM` adds a receiver, `to` alone forgets them all. `performer`: whose bodies it
  // gets, -1: everybody's. A name is looked up on the worker, for it may take seconds.
  void to(const Arguments& arguments, int performer);
  // Whose bodies are sent from now on, and of how many performers. Throws Error when a form that is
  // sent cannot tell the model's body; nothing has changed then.
  void use(std::shared_ptr<const Model> model, int performers);
  // `root` and `pose` of a performer. Neither allocates nor throws. False: another count of numbers
  // than expected().
  bool take(const Arguments& arguments, int performer) noexcept;
  int expected(std::string_view selector) const noexcept;
  // Whether the system has refused a packet since this was asked last.
  bool take_failure() noexcept { return std::exchange(failed_, false); }

  int count() const noexcept { return static_cast<int>(receivers_.size()); }
  // The messages that make it so again.
  void dump(Outlet& info) const;

 private:
  static constexpr int most = 16;
  struct Receiver {
    std::string host;
    int port = 0, performer = -1;
    osc::MocapForm form = osc::MocapForm::vmc;
    std::shared_ptr<const osc::Destination> destination;
    bool is(const Receiver& other) const noexcept {
      return host == other.host && port == other.port && form == other.form &&
             performer == other.performer;
    }
  };
  struct Found {
    std::shared_ptr<const osc::Destination> destination;
    std::string reason;
  };
  std::vector<osc::BodySender> senders_for(const std::shared_ptr<const Model>& model) const;
  void add(Receiver receiver, const Found& found);

  Box& box_;
  bool blocking_ = false;
  std::shared_ptr<const Model> model_;
  std::vector<Receiver> receivers_;
  std::vector<osc::BodySender> senders_;  // one for each form that is sent
  std::array<std::shared_ptr<const osc::Destination>, most> to_;
  std::vector<float> pose_, roots_;  // of one performer, of all
  bool failed_ = false;
  int lookups_ = 0;  // those begun before all were forgotten count for nothing
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
};

}  // namespace gait::pd
