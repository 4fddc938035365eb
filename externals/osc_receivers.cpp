#include "osc_receivers.h"

#include <algorithm>
#include <span>

#include "gait/error.h"
#include "gait/osc/forms.h"

namespace gait::pd {

void OscReceivers::to(const Arguments& arguments, int performer) {
  arguments.expect_count(0, 3);
  if (arguments.size() == 0) {
    ++lookups_;
    std::erase_if(receivers_, [&](const Receiver& receiver) {
      return performer < 0 || receiver.performer == performer;
    });
    senders_ = senders_for(model_);
    to_.fill(nullptr);
    return;
  }
  Receiver wanted;
  wanted.performer = performer;
  wanted.host = arguments.text(0);
  wanted.port = arguments.size() > 1 ? arguments.integer(1, 1, 65535) : 39539;
  if (arguments.size() > 2) {
    const auto form = osc::form_named(arguments.symbol(2));
    if (!form || (!osc::is_sent(*form) && *form != osc::MocapForm::wekinator))
      arguments.fail_at(2, osc::form_names_text(true) + "; or wekinator for 'outputs'");
    wanted.form = *form;
  }
  if (std::ranges::any_of(receivers_, [&](const Receiver& known) { return known.is(wanted); }))
    return;
  if (count() == most) arguments.fail("expected at most 16 receivers; `to` alone forgets them");
  using Found = std::shared_ptr<const osc::Destination>;
  const auto current = [this, lookups = lookups_] { return lookups == lookups_; };
  background_.run(
      [wanted] { return std::make_shared<const osc::Destination>(wanted.host, wanted.port); },
      [this, wanted, current](Found found) {
        if (current()) add(wanted, std::move(found));
      },
      [this, current](const std::string& reason) {
        if (current()) complain(box_, "to: " + reason);
      });
}

void OscReceivers::add(Receiver receiver, std::shared_ptr<const osc::Destination> found) {
  // The same receiver, or too many, may have been asked for before the first one was found.
  const bool known =
      std::ranges::any_of(receivers_, [&](const Receiver& other) { return other.is(receiver); });
  if (known || count() == most) return;
  receiver.destination = std::move(found);
  receivers_.push_back(std::move(receiver));
  try {
    senders_ = senders_for(model_);
  } catch (const std::exception& error) {
    receivers_.pop_back();
    complain(box_, std::string("to: ") + error.what());
  }
}

std::vector<osc::BodySender> OscReceivers::senders_for(
    const std::shared_ptr<const Model>& model) const {
  std::vector<osc::BodySender> senders;
  if (!model || !model->body) return senders;
  for (const Receiver& receiver : receivers_) {
    if (!osc::is_sent(receiver.form)) continue;
    const auto same = [&](const osc::BodySender& s) { return s.form() == receiver.form; };
    if (std::ranges::none_of(senders, same)) senders.emplace_back(model, receiver.form);
  }
  return senders;
}

void OscReceivers::use(std::shared_ptr<const Model> model, int performers) {
  senders_ = senders_for(model);
  model_ = std::move(model);
  pose_.resize(static_cast<std::size_t>(expected("pose")));
  roots_.assign(4 * static_cast<std::size_t>(performers), 0);
}

int OscReceivers::expected(std::string_view selector) const noexcept {
  if (selector == "root") return 4;
  return model_ && model_->body ? 3 * model_->body->skeleton.size() : 0;
}

bool OscReceivers::take(const Arguments& arguments, int performer) noexcept {
  const std::span<float> root(roots_.data() + 4 * static_cast<std::ptrdiff_t>(performer), 4);
  if (arguments.selector() == "root") return arguments.read(root);
  if (pose_.empty() || !arguments.read(pose_)) return false;
  for (osc::BodySender& sender : senders_) {
    std::size_t count = 0;
    for (const Receiver& receiver : receivers_)
      if (receiver.form == sender.form() &&
          (receiver.performer < 0 || receiver.performer == performer))
        to_[count++] = receiver.destination;
    if (count > 0 &&
        !sender.send(root, pose_, clock_gettimesince(0) / 1000, std::span(to_).first(count)))
      failed_ = true;
  }
  return true;
}

bool OscReceivers::send_outputs(const Arguments& arguments) {
  constexpr int most_outputs = 256;
  const int count = arguments.size();
  if (count < 1 || count > most_outputs) return false;
  numbers_.resize(static_cast<std::size_t>(count));
  if (!arguments.read(numbers_)) return false;
  if (!outputs_ || outputs_->numbers() != count) {
    outputs_.emplace();
    outputs_->add("/wek/outputs", std::string(static_cast<std::size_t>(count), 'f'));
  }
  outputs_->set(numbers_);
  // The message alone, without its bundle.
  const auto message = outputs_->bytes().subspan(osc::PacketTemplate::head);
  for (const Receiver& receiver : receivers_)
    if (receiver.form == osc::MocapForm::wekinator && !receiver.destination->send(message))
      failed_ = true;
  return !failed_;
}

void OscReceivers::dump(Outlet& info) const {
  for (const Receiver& receiver : receivers_) {
    if (receiver.performer >= 0) info.add(receiver.performer).add("to");
    info.add(receiver.host)
        .add(receiver.port)
        .add(std::string(osc::form_name(receiver.form)))
        .send(receiver.performer >= 0 ? "list" : "to");
  }
}

}  // namespace gait::pd
