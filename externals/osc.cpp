// [gait.osc NAME -poly n]: live motion from suits, cameras and phones in, bodies to avatars out.
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "gait/error.h"
#include "gait/osc/body_sender.h"
#include "gait/osc/receiver.h"
#include "objects.h"
#include "osc_voice.h"
#include "pd/models.h"
#include "pd/ticker.h"
#include "pd/worker.h"

namespace gait::pd {

namespace {

constexpr int most_voices = 64, most_receivers = 16;
constexpr double poll_interval = 1;  // ms; arrivals wait so long and a scheduler's tick at most
constexpr int most_events_a_poll = 4096;  // a flood must not stop the music

class Osc final : public ModelUser, osc::FrameSink {
 public:
  Osc(Box& box, const Arguments& arguments)
      : ModelUser(box, is_name(arguments) ? arguments.text(0) : ""),
        in_(box),
        pose_(box),
        info_(box) {
    for (int at = is_name(arguments) ? 1 : 0; at < arguments.size(); ++at) {
      const std::string flag = arguments.symbol(at);
      if (flag == "-poly")
        count_ = arguments.integer(++at, 1, most_voices);
      else if (flag == "-blocking")
        blocking_ = true;
      else
        arguments.fail_at(at, "-poly n or -blocking");
    }
    join();
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
      to(arguments);
    else if (selector == "calibrate")
      calibrate(arguments);
    else if (selector == "yaw")
      set(arguments, settings_.yaw, -360, 360);
    else if (selector == "jitter")
      set(arguments, settings_.jitter, 0, 1000);
    else if (selector == "hold")
      set(arguments, settings_.hold, 0.01, 60);
    else if (selector == "smooth")
      set(arguments, settings_.smooth, 0, 60);
    else if (selector == "reset")
      reset();
    else if (selector == "print")
      print();
    else if (selector == "dump")
      dump();
    else if (selector == "perf")
      report_perf();
    else
      arguments.fail("no such message");
  }
  // Of several performers, one's pose after his number.
  void list(const Arguments& arguments) {
    if (count_ == 0 || !arguments.is_symbol(1)) arguments.fail("no such message");
    const int voice = arguments.integer(0, 0, count_ - 1);
    const auto atoms = arguments.atoms().subspan(2);
    outgoing(Arguments(box().name(), arguments.atoms()[1].a_w.w_symbol->s_name,
                       static_cast<int>(atoms.size()), atoms.data()),
             voice);
  }

 private:
  struct Receiving {  // a program that takes what is sent
    std::string host;
    int port = 0;
    osc::MocapForm form = osc::MocapForm::vmc;
    std::shared_ptr<const osc::Destination> to;
  };
  struct Resolved {
    std::shared_ptr<const osc::Destination> to;
    std::string reason;
  };

  static bool is_name(const Arguments& arguments) {
    return arguments.size() > 0 &&
           !(arguments.is_symbol(0) && arguments.symbol(0).starts_with('-'));
  }

  void take(const SharedModel& shared, const SharedModel&) override {
    std::vector<std::unique_ptr<OscVoice>> voices;
    for (int i = 0; i < std::max(1, count_); ++i)
      voices.push_back(std::make_unique<OscVoice>(shared->model, count_ > 0 ? i : -1, settings_));
    std::vector<osc::BodySender> senders = senders_for(shared);
    voices_ = std::move(voices);
    senders_ = std::move(senders);
    const int values = shared->model->body ? 3 * shared->model->body->skeleton.size() : 0;
    given_.resize(static_cast<std::size_t>(values));
    root_.assign(4 * static_cast<std::size_t>(std::max(1, count_)), 0);
    for (Outlet* outlet : {&in_, &pose_, &info_})
      outlet->reserve(std::max(values, values_of(shared->model->inputs)) + 8);
  }
  void say_ready() override { info_.add_text(model_name()).send("ready"); }

  std::vector<osc::BodySender> senders_for(const SharedModel& shared) {
    std::vector<osc::BodySender> senders;
    if (!shared || !shared->model->body) return senders;
    for (const Receiving& receiving : receiving_) {
      const auto same = [&](const osc::BodySender& s) { return s.form() == receiving.form; };
      if (std::ranges::none_of(senders, same)) senders.emplace_back(shared->model, receiving.form);
    }
    return senders;
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
        arguments.fail_at(i, "any, or a form: vmc, natnet, neuron, kinect, gait");
    }
    if (receiver_ && wanted.port == listening_.port && wanted.any == listening_.any &&
        wanted.form == listening_.form)
      return;
    // The same port in another way needs the old one closed; another port leaves it until it works.
    if (receiver_ && wanted.port == listening_.port) close();
    try {
      auto opened = std::make_unique<osc::Receiver>(wanted);
      close();
      receiver_ = std::move(opened);
    } catch (const Error& error) {
      arguments.fail(error.what());
    }
    listening_ = wanted;
    gatherer_.emplace(std::max(1, count_));
    dropped_ = 0;
    poll_.after(0);
  }

  void close() {
    poll_.cancel();
    receiver_.reset();
  }

  // A name is looked up on the worker: it may take seconds.
  void to(const Arguments& arguments) {
    arguments.expect_count(0, 3);
    if (arguments.size() == 0) {  // to nobody
      ++lookups_;
      receiving_.clear();
      senders_.clear();
      return;
    }
    Receiving wanted;
    wanted.host = arguments.text(0);
    wanted.port = arguments.size() > 1 ? arguments.integer(1, 1, 65535) : 39539;
    if (arguments.size() > 2) {
      const auto form = osc::form_named(arguments.symbol(2));
      if (!form || *form == osc::MocapForm::kinect)
        arguments.fail_at(2, "vmc, natnet, neuron or gait");
      wanted.form = *form;
    }
    for (const Receiving& known : receiving_)
      if (known.host == wanted.host && known.port == wanted.port && known.form == wanted.form)
        return;
    if (static_cast<int>(receiving_.size()) == most_receivers)
      arguments.fail("expected at most 16 receivers; `to` alone forgets them");
    const auto result = std::make_shared<Resolved>();
    Worker::get().run(
        [result, wanted] {
          try {
            result->to = std::make_shared<const osc::Destination>(wanted.host, wanted.port);
          } catch (const std::exception& error) {
            result->reason = error.what();
          }
        },
        [this, alive = std::weak_ptr<bool>(alive_), result, wanted, lookups = lookups_]() mutable {
          if (alive.expired() || lookups != lookups_) return;
          add(std::move(wanted), *result);
        },
        blocking_);
  }

  void add(Receiving wanted, const Resolved& resolved) {
    std::string reason = resolved.reason;
    if (resolved.to) {
      wanted.to = resolved.to;
      receiving_.push_back(std::move(wanted));
      try {
        senders_ = senders_for(model());
        return;
      } catch (const std::exception& error) {
        receiving_.pop_back();
        reason = error.what();
      }
    }
    const std::string line = std::string(box().name()) + ": to: " + reason;
    say_error(box(), line.c_str());
  }

  void calibrate(const Arguments& arguments) {
    arguments.expect_count(1);
    const std::string pose = arguments.symbol(0);
    if (pose != "t" && pose != "i") arguments.fail_at(0, "t or i");
    for (const auto& voice : voices_)
      voice->calibrate(pose == "t" ? CalibrationPose::t : CalibrationPose::i);
  }

  void set(const Arguments& arguments, double& setting, double least, double most) {
    arguments.expect_count(1);
    setting = arguments.number(0, least, most);
    for (const auto& voice : voices_) voice->set(settings_);
  }

  void outgoing(const Arguments& arguments, int voice) {
    if (!ready_for_frame()) return;
    const std::span<float> root(root_.data() + 4 * static_cast<std::ptrdiff_t>(voice), 4);
    if (arguments.selector() == "root") {
      if (!arguments.read(root)) wrong(arguments, 4);
      return;
    }
    if (arguments.selector() != "pose") arguments.fail("no such message");
    if (given_.empty() || !arguments.read(given_)) {
      wrong(arguments, given_.size());
      return;
    }
    const Perf::Frame measured(perf());
    for (osc::BodySender& sender : senders_) {
      std::size_t count = 0;
      for (const Receiving& receiving : receiving_)
        if (receiving.form == sender.form()) to_[count++] = receiving.to;
      sender.send(root, given_, clock_gettimesince(0) / 1000, std::span(to_).first(count));
    }
  }
  void wrong(const Arguments& arguments, std::size_t count) {
    slow_error().say([&] {
      return std::string(box().name()) + ": " + std::string(arguments.selector()) + ": expected " +
             std::to_string(count) + " numbers, got " + std::to_string(arguments.size());
    });
  }

  void frame(int performer, const osc::CapturedFrame& captured) noexcept override {
    if (performer < static_cast<int>(voices_.size())) voices_[performer]->take(captured);
  }

  void poll() {
    poll_.after(poll_interval);
    osc::MocapEvent event;
    for (int i = 0; i < most_events_a_poll && receiver_->pop(event); ++i)
      if (model())
        gatherer_->take(event, *this);
      else if (event.kind == osc::MocapKind::edge)
        ready_for_frame();  // drops and counts it
    if (!receiver_) return;
    const double now = osc::Receiver::now();
    gatherer_->end_old(now, *this);
    // What is sent may come back here as any message: nothing below relies on what is above.
    for (std::size_t i = 0; i < voices_.size(); ++i) {
      voices_[i]->release(now, in_, pose_, info_, perf(), latency_);
      voices_[i]->report(now, info_);
    }
    if (now - reported_ >= 1) report(now);
  }

  void report(double now) {
    reported_ = now;
    if (!receiver_) return;
    const osc::Received received = receiver_->received();
    std::uint64_t dropped = received.dropped + received.faulty + gatherer_->refused();
    for (const auto& voice : voices_) dropped += static_cast<std::uint64_t>(voice->unfit());
    if (dropped == dropped_) return;
    const auto more = dropped - dropped_;
    dropped_ = dropped;
    slow_error().say([&] {
      return std::string(box().name()) + ": " + std::to_string(more) +
             " events were dropped: faulty, of performers beyond the number asked for, of another "
             "model, or too many at once";
    });
    info_.add(static_cast<double>(dropped)).send("dropped");
  }

  void report_perf() {
    latency_.report(info_);
    perf().report(info_);
  }

  void reset() {
    for (const auto& voice : voices_) voice->reset();
    if (gatherer_) gatherer_.emplace(std::max(1, count_));
  }

  void print() const {
    if (!receiver_) {
      post("%s: listens to nobody, sends to %d", const_cast<Box&>(box_of()).name(),
           static_cast<int>(receiving_.size()));
      return;
    }
    const osc::Received received = receiver_->received();
    post(
        "%s: port %d%s, %.0f packets, %.0f messages, %.0f of no body, %.0f faulty, %.0f dropped; "
        "sends to %d",
        const_cast<Box&>(box_of()).name(), receiver_->port(),
        listening_.any ? " from anywhere" : "", static_cast<double>(received.packets),
        static_cast<double>(received.messages), static_cast<double>(received.unknown),
        static_cast<double>(received.faulty), static_cast<double>(received.dropped),
        static_cast<int>(receiving_.size()));
  }
  const Box& box_of() const { return const_cast<Osc*>(this)->box(); }

  void dump() {
    if (receiver_) {
      info_.add(receiver_->port());
      if (listening_.any) info_.add("any");
      if (listening_.form != osc::MocapForm::none)
        info_.add(std::string(osc::form_name(listening_.form)));
      info_.send("listen");
    }
    for (const Receiving& receiving : receiving_)
      info_.add(receiving.host)
          .add(receiving.port)
          .add(std::string(osc::form_name(receiving.form)))
          .send("to");
    info_.add(settings_.yaw).send("yaw");
    info_.add(settings_.jitter).send("jitter");
    info_.add(settings_.hold).send("hold");
    info_.add(settings_.smooth).send("smooth");
  }

  Outlet in_, pose_, info_;
  int count_ = 0;  // performers told apart, 0: one without a number
  bool blocking_ = false;
  OscSettings settings_;
  osc::ReceiverSettings listening_;
  std::unique_ptr<osc::Receiver> receiver_;
  std::optional<osc::FrameGatherer> gatherer_;
  std::vector<std::unique_ptr<OscVoice>> voices_;
  std::vector<Receiving> receiving_;
  std::vector<osc::BodySender> senders_;  // one for each form that is sent
  std::array<std::shared_ptr<const osc::Destination>, most_receivers> to_;
  std::vector<float> given_, root_;
  Latency latency_;
  double reported_ = 0;
  std::uint64_t dropped_ = 0;
  int lookups_ = 0;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
  Ticker poll_{[this] { poll(); }};
};

}  // namespace

void setup_osc() {
  if (!may_register("gait.osc")) return;
  Class<Osc>("gait.osc").list<&Osc::list>().anything<&Osc::message>();
}

}  // namespace gait::pd
