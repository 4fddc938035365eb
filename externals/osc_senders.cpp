#include "osc_senders.h"

#include <m_pd.h>

#include <algorithm>

#include "gait/osc/forms.h"
#include "gait/platform/udp_socket.h"

namespace gait::pd {

namespace {

constexpr std::size_t most_told = 64;

bool sends_now(const osc::FrameSource& source, double now) {
  return source.used() && source.frames() > 0 && now - source.seen() < osc::FrameSource::lately;
}

int bones_of(const osc::FrameSource& source) {
  return source.frame().joints > 0 ? source.frame().joints
                                   : static_cast<int>(source.bones().count());
}

}  // namespace

void OscSenders::from(const Arguments& arguments, int performer) {
  arguments.expect_count(0, 2);
  const auto of_performer = [performer](const Choice& choice) {
    return performer < 0 || choice.performer == performer;
  };
  if (arguments.size() == 0) {
    ++lookups_;
    std::erase_if(choices_, of_performer);
    apply();
    return;
  }
  Choice wanted{
      performer, arguments.text(0), arguments.size() > 1 ? arguments.integer(1, 1, 65535) : 0, {}};
  const auto current = [this, lookups = ++lookups_] { return lookups == lookups_; };
  using Found = std::vector<UdpAddress>;
  background_.run([wanted] { return addresses_of(wanted.host, wanted.port, wanted.host); },
                  [this, wanted, current, of_performer](Found found) {
                    if (!current()) return;
                    std::erase_if(choices_, of_performer);
                    choices_.push_back(wanted);
                    choices_.back().addresses = std::move(found);
                    apply();
                  },
                  [this, current](const std::string& reason) {
                    if (current()) complain(box_, "from: " + reason);
                  });
}

void OscSenders::use(osc::FrameGatherer* gatherer) {
  gatherer_ = gatherer;
  told_.clear();
  apply();
}

// What is chosen for one performer counts before what is chosen for all.
void OscSenders::apply() const {
  if (!gatherer_) return;
  for (int i = 0; i < gatherer_->performers(); ++i) {
    std::vector<UdpAddress> from;
    for (const int performer : {-1, i})
      for (const Choice& choice : choices_)
        if (choice.performer == performer) from = choice.addresses;
    gatherer_->choose(i, std::move(from));
  }
}

void OscSenders::dump(Outlet& info) const {
  for (const Choice& choice : choices_) {
    if (choice.performer >= 0) info.add(choice.performer).add("from");
    info.add(choice.host);
    if (choice.port > 0) info.add(choice.port);
    info.send(choice.performer >= 0 ? "list" : "from");
  }
}

void OscSenders::list(double now, Outlet& info) const {
  if (!gatherer_) return;
  for (std::size_t i = 0; i < gatherer_->sources().size(); ++i) {
    const osc::FrameSource& source = gatherer_->sources()[i];
    if (!sends_now(source, now)) continue;
    info.add(source.frame().sender.name())
        .add(std::string(osc::form_name(source.frame().form)))
        .add(source.rate())
        .add(bones_of(source))
        .add(gatherer_->performer_of(static_cast<int>(i)))
        .send("sender");
  }
}

void OscSenders::tell_left_out(double now) {
  if (!gatherer_) return;
  for (std::size_t i = 0; i < gatherer_->sources().size(); ++i) {
    const osc::FrameSource& source = gatherer_->sources()[i];
    if (!sends_now(source, now) || source.frames() < 10 || told_.size() == most_told ||
        gatherer_->performer_of(static_cast<int>(i)) >= 0 ||
        std::ranges::find(told_, source.frame().sender) != told_.end())
      continue;
    told_.push_back(source.frame().sender);
    logpost(&box_, 2, "gait.osc: %s (%s, %d bones) sends too, and is no performer: see 'senders'",
            source.frame().sender.name().c_str(),
            std::string(osc::form_name(source.frame().form)).c_str(), bones_of(source));
  }
}

}  // namespace gait::pd
