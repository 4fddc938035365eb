// [gait.osc NAME -poly n]: receives live motion from suits, cameras and phones, and sends bodies to
// avatars.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gait/error.h"
#include "gait/osc/forms.h"
#include "gait/osc/frame_gatherer.h"
#include "gait/osc/receiver.h"
#include "objects.h"
#include "osc_receivers.h"
#include "osc_senders.h"
#include "osc_voice.h"
#include "pd/models.h"
#include "pd/ticker.h"

namespace gait::pd {

namespace {

constexpr double poll_interval = 1;       // ms: arrivals wait for at most this and a tick of Pd's
constexpr int most_events_a_poll = 4096;  // so that a flood of packets does not block Pd

class Osc final : public ModelUser, osc::FrameSink {
 public:
  Osc(Box& box, const Arguments& arguments)
      : ModelUser(box, arguments.is_word(0) ? arguments.text(0) : ""),
        in_(box),
        pose_(box),
        info_(box),
        receivers_(box),
        senders_(box) {
    for (int at = arguments.is_word(0) ? 1 : 0; at < arguments.size(); ++at) {
      const std::string flag = arguments.symbol(at);
      if (flag == "-poly")
        count_ = arguments.integer(++at, 1, most_voices);
      else if (flag == "-blocking")
        receivers_.set_blocking(), senders_.set_blocking();
      else
        arguments.fail_at(at, "-poly n or -blocking");
    }
    plain_.reserve(osc::most_values);
    in_.reserve(osc::most_values + 8);
    join(info_);
  }

  void message(const Arguments& arguments) {
    const auto selector = arguments.selector();
    if (selector == "pose" || selector == "root")
      outgoing(arguments, 0);
    else if (selector == "listen")
      listen(arguments);
    else if (selector == "close")
      close();
    else if (selector == "to")
      receivers_.to(arguments, -1);
    else if (selector == "outputs")
      outputs(arguments);
    else if (selector == "from")
      senders_.from(arguments, -1);
    else if (selector == "senders")
      senders_.list(osc::Receiver::now(), info_);
    else if (selector == "calibrate")
      calibrate(arguments, -1);
    else if (selector == "yaw")
      set(arguments, settings_.yaw, -360, 360);
    else if (selector == "jitter")
      set(arguments, settings_.jitter, 0, 1000);
    else if (selector == "hold")
      set(arguments, settings_.hold, 0.01, 60);
    else if (selector == "smooth")
      set(arguments, settings_.smooth, 0, 60);
    else
      arguments.fail("no such message");
  }
  // With -poly, a message to one performer begins with the performer's number.
  void list(const Arguments& arguments) {
    if (count_ == 0 || !arguments.is_symbol(1)) arguments.fail("no such message");
    const int voice = arguments.integer(0, 0, count_ - 1);
    const auto atoms = arguments.atoms().subspan(2);
    const Arguments message(box().name(), arguments.atoms()[1].a_w.w_symbol->s_name,
                            static_cast<int>(atoms.size()), atoms.data());
    if (message.selector() == "pose" || message.selector() == "root")
      outgoing(message, voice);
    else if (message.selector() == "calibrate")
      calibrate(message, voice);
    else if (message.selector() == "to")
      receivers_.to(message, voice);
    else if (message.selector() == "from")
      senders_.from(message, voice);
    else
      message.fail("expected pose, root, calibrate, from or to after a performer's number");
  }

  void report_perf(const Arguments& arguments) {
    latency_.report(info_);
    ModelUser::report_perf(arguments);
  }

  void reset(const Arguments&) {
    settle_dropped();
    for (const auto& voice : voices_) voice->reset();
    if (gatherer_) gather();
    counted_ = count_dropped();
  }

  void print(const Arguments&) {
    if (!receiver_) {
      post("%s: listens to nobody, sends to %d", box().name(), receivers_.count());
      return;
    }
    const osc::Received received = receiver_->received();
    post(
        "%s: port %d%s, %.0f packets, %.0f messages, %.0f of no body, %.0f faulty, %.0f dropped; "
        "sends to %d",
        box().name(), receiver_->port(), listening_.any ? " from anywhere" : "",
        static_cast<double>(received.packets), static_cast<double>(received.messages),
        static_cast<double>(received.unknown), static_cast<double>(received.faulty),
        static_cast<double>(received.dropped), receivers_.count());
  }

  void dump(const Arguments&) {
    if (receiver_) {
      info_.add(receiver_->port());
      if (listening_.any) info_.add("any");
      if (listening_.form != osc::MocapForm::none)
        info_.add(std::string(osc::form_name(listening_.form)));
      info_.send("listen");
    }
    receivers_.dump(info_);
    senders_.dump(info_);
    info_.add(settings_.yaw).send("yaw");
    info_.add(settings_.jitter).send("jitter");
    info_.add(settings_.hold).send("hold");
    info_.add(settings_.smooth).send("smooth");
  }

 private:
  void follow(const SharedModel& shared) override {
    std::vector<std::shared_ptr<OscVoice>> voices;
    for (int i = 0; i < std::max(1, count_); ++i) {
      voices.push_back(std::make_shared<OscVoice>(shared->model, count_ > 0 ? i : -1, settings_));
      if (!voices_.empty()) voices.back()->take_over(*voices_[static_cast<std::size_t>(i)]);
    }
    receivers_.use(shared->model, std::max(1, count_));
    settle_dropped();
    voices_ = std::move(voices);
    counted_ = count_dropped();
    for (Outlet* outlet : {&in_, &pose_, &info_})
      outlet->reserve(std::max(receivers_.expected("pose"), values_of(shared->model->inputs)) + 8);
  }

  void listen(const Arguments& arguments) {
    arguments.expect_count(1, 3);
    osc::ReceiverSettings wanted;
    wanted.port = arguments.integer(0, 1, 65535);
    for (int i = 1; i < arguments.size(); ++i) {
      const std::string word = arguments.symbol(i);
      const auto form = osc::form_named(word);
      if (word == "any")
        wanted.any = true;
      else if (form)
        wanted.form = *form;
      else
        arguments.fail_at(i, "any, or a form: " + osc::form_names_text());
    }
    if (receiver_ && wanted.port == listening_.port && wanted.any == listening_.any &&
        wanted.form == listening_.form)
      return;
    // The same port in another way needs the old one closed; another port leaves it until it works.
    if (receiver_ && wanted.port == listening_.port) close();
    std::unique_ptr<osc::Receiver> opened;
    try {
      opened = std::make_unique<osc::Receiver>(wanted);
    } catch (const Error& error) {
      arguments.fail(error.what());
    }
    settle_dropped();
    receiver_ = std::move(opened);
    gather();
    counted_ = count_dropped();
    listening_ = wanted;
    poll_.after(0);
    end_streams();
  }

  void close() {
    settle_dropped();
    poll_.cancel();
    receiver_.reset();
    senders_.use(nullptr);
    gatherer_.reset();
    counted_ = count_dropped();
    end_streams();
  }

  void gather() {
    gatherer_.emplace(std::max(1, count_));
    senders_.use(&*gatherer_);
  }

  void end_streams() {
    const auto voices = voices_;  // a message sent may come back and change them
    for (const auto& voice : voices) voice->end(info_);
  }

  // Of all performers, or of the one with the number `only`.
  void calibrate(const Arguments& arguments, int only) {
    const std::string pose = arguments.only().symbol(0);
    if (pose != "t" && pose != "i") arguments.fail_at(0, "t or i");
    bool found = false;
    for (int i = 0; i < static_cast<int>(voices_.size()); ++i)
      if ((only < 0 || i == only) &&
          voices_[static_cast<std::size_t>(i)]->calibrate(
              pose == "t" ? CalibrationPose::t : CalibrationPose::i, osc::Receiver::now()))
        found = true;
    if (!found) arguments.fail("expected a performer who is there; nobody sends");
  }

  void set(const Arguments& arguments, double& setting, double least, double most) {
    setting = arguments.only().number(0, least, most);
    for (const auto& voice : voices_) voice->set(settings_);
  }

  void outgoing(const Arguments& arguments, int voice) {
    if (!ready_for_frame()) return;
    const Perf::Frame measured(perf());
    if (receivers_.take(arguments, voice)) {
      if (receivers_.take_failure())
        slow_error().say([] { return "to: the network did not take a body"; });
      return;
    }
    slow_error().say([&] {
      return std::string(arguments.selector()) + ": expected " +
             std::to_string(receivers_.expected(arguments.selector())) + " numbers, got " +
             std::to_string(arguments.size());
    });
  }

  // What a patch has learnt, to those who take Wekinator's outputs.
  void outputs(const Arguments& arguments) {
    if (!receivers_.send_outputs(arguments)) {
      if (receivers_.take_failure())
        slow_error().say([] { return "to: the network did not take the outputs"; });
      else
        slow_error().say([] { return "outputs: expected 1 to 256 numbers"; });
    }
  }

  void frame(int performer, const osc::CapturedFrame& captured) noexcept override {
    if (performer < static_cast<int>(voices_.size())) voices_[performer]->take(captured);
  }

  void poll() {
    poll_.after(poll_interval);
    osc::MocapEvent event;
    for (int i = 0; i < most_events_a_poll && receiver_->pop(event); ++i)
      if (event.kind == osc::MocapKind::plain)
        take_plain(event);
      else if (model())
        gatherer_->take(event, *this);
      else if (event.kind == osc::MocapKind::edge)
        ready_for_frame();  // drops and counts it
    if (!receiver_) return;
    const double now = osc::Receiver::now();
    gatherer_->end_old(now, *this);
    // A message sent may come back as any message to this box, even with another model. So this
    // keeps each voice alive until it has sent all its messages.
    for (std::size_t i = 0; i < voices_.size(); ++i) {
      const std::shared_ptr<OscVoice> voice = voices_[i];
      voice->release(now, in_, pose_, info_, perf(), latency_);
      voice->report(now, info_);
    }
    if (now - reported_ >= 1) report(now);
  }

  // `plain NAME x ...`, once all numbers of the stream are there.
  void take_plain(const osc::MocapEvent& event) {
    if (event.first == 0) plain_.clear();
    plain_.insert(plain_.end(), event.numbers.begin(), event.numbers.begin() + event.count);
    if (static_cast<int>(plain_.size()) != event.total) return;
    in_.add(event.name.data()).add(std::span<const float>(plain_)).send("plain");
  }

  void report(double now) {
    reported_ = now;
    senders_.tell_left_out(now);
    const std::uint64_t before = told_dropped_;
    settle_dropped();
    if (dropped_ == before) return;
    const auto more = dropped_ - before;
    told_dropped_ = dropped_;
    slow_error().say([&] {
      return std::to_string(more) +
             " events were dropped: faulty, of another model, of too many senders, or too many at "
             "once";
    });
    info_.add(static_cast<double>(dropped_)).send("dropped");
  }

  // Events dropped, as the receiver, the gatherer and the voices that there are now have counted.
  std::uint64_t count_dropped() const {
    std::uint64_t count = 0;
    if (receiver_) {
      const osc::Received received = receiver_->received();
      count += received.dropped + received.faulty;
    }
    if (gatherer_) count += gatherer_->refused();
    for (const auto& voice : voices_) count += static_cast<std::uint64_t>(voice->dropped());
    return count;
  }
  // Adds to dropped_ what they counted since the last call. To be called before one of them is
  // replaced, whose counter then begins at 0; counted_ is to be set after that.
  void settle_dropped() {
    const std::uint64_t count = count_dropped();
    dropped_ += count - counted_;
    counted_ = count;
  }

  Outlet in_, pose_, info_;
  OscReceivers receivers_;
  OscSenders senders_;
  int count_ = 0;  // performers of -poly, 0: one without a number
  OscSettings settings_;
  osc::ReceiverSettings listening_;
  std::unique_ptr<osc::Receiver> receiver_;
  std::optional<osc::FrameGatherer> gatherer_;
  std::vector<std::shared_ptr<OscVoice>> voices_;
  std::vector<float> plain_;  // of the stream that comes now
  Latency latency_;
  double reported_ = 0;
  std::uint64_t dropped_ = 0, told_dropped_ = 0, counted_ = 0;  // counted_: of count_dropped()
  Ticker poll_{[this] { poll(); }};
};

}  // namespace

void setup_osc() { Class<Osc>("gait.osc").list<&Osc::list>().common().anything<&Osc::message>(); }

}  // namespace gait::pd
