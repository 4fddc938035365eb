// The programs that [gait.osc] sends bodies to.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gait/osc/body_sender.h"
#include "pd/background.h"
#include "pd/outlet.h"

namespace gait::pd {

class OscReceivers {
 public:
  explicit OscReceivers(Box& box) : box_(box) {}
  // Names are looked up at once, on this thread.
  void set_blocking() { background_.set_blocking(true); }

  // `to HOST PORT FORM` adds a receiver, `to` alone removes them all. `performer`: the one whose
  // bodies it gets, -1: those of all. The worker looks a name up, which may take seconds.
  void to(const Arguments& arguments, int performer);
  // Sends bodies of this model from now on, of so many performers. Throws Error, with nothing
  // changed, when a receiver's form cannot carry the model's body.
  void use(std::shared_ptr<const Model> model, int performers);
  // Takes `root` or `pose` of a performer; a pose is sent. Neither allocates nor throws. False: the
  // count of numbers is not expected().
  bool take(const Arguments& arguments, int performer) noexcept;
  // Sends /wek/outputs with these numbers to all receivers of the form `wekinator`. False: they are
  // no numbers, or the system has refused a packet.
  bool send_outputs(const Arguments& arguments);
  int expected(std::string_view selector) const noexcept;
  // Whether the system has refused a packet since this was asked last.
  bool take_failure() noexcept { return std::exchange(failed_, false); }

  int count() const noexcept { return static_cast<int>(receivers_.size()); }
  // The messages that restore the receivers.
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
  std::vector<osc::BodySender> senders_for(const std::shared_ptr<const Model>& model) const;
  void add(Receiver receiver, std::shared_ptr<const osc::Destination> found);

  Box& box_;
  std::shared_ptr<const Model> model_;
  std::vector<Receiver> receivers_;
  std::vector<osc::BodySender> senders_;  // one for each form that is sent
  std::array<std::shared_ptr<const osc::Destination>, most> to_;
  std::vector<float> pose_, roots_;             // of one performer, of all
  std::optional<osc::PacketTemplate> outputs_;  // made anew for another count
  std::vector<float> numbers_;
  bool failed_ = false;
  int lookups_ = 0;  // `to` alone raises it: look-ups begun before that add nothing
  Background background_;
};

}  // namespace gait::pd
