// [gait.synth NAME]: from Gaussians to smooth frames (T14 §4.3); without them it walks by itself.
#include <cmath>

#include "gait/error.h"
#include "objects.h"
#include "pd/models.h"
#include "pd/ticker.h"
#include "synth_setting.h"

namespace gait::pd {

namespace {

constexpr double longest_advance = 60;  // seconds at once

class Synth final : public ModelUser {
 public:
  Synth(Box& box, const Arguments& arguments)
      : ModelUser(box, arguments.size() > 0 ? arguments.text(0) : ""), out_(box), info_(box) {
    arguments.expect_count(0, 1);
    join();
  }

  // One frame in, one frame out.
  void gauss(const Arguments& arguments) {
    if (!ready_for_frame()) return;
    const int values = model()->model->output.values;
    if (!arguments.read(gauss_) || gauss_[1] != static_cast<float>(values)) {
      slow_error().say([&] {
        return std::string(box().name()) + ": gauss: expected " + std::to_string(gauss_.size()) +
               " numbers for " + std::to_string(values) + " values, got " +
               std::to_string(arguments.size());
      });
      return;
    }
    const auto size = static_cast<std::size_t>(3 * values);
    const auto means = std::span<const float>(gauss_).subspan(2, size);
    const auto variances = std::span<const float>(gauss_).subspan(2 + size, size);
    if (!synthesiser_->fits(means, variances) || !(gauss_[0] >= 0 && gauss_[0] <= 1000)) {
      slow_error().say([&] {
        return std::string(box().name()) +
               ": gauss: expected finite means and positive variances of what moves";
      });
      return;
    }
    flows_ = fed_ = true;
    lost_ = false;
    run();
    lag_ = static_cast<int>(gauss_[0]);
    bool made = false;
    {
      const Perf::Frame frame(perf());
      made = synthesiser_->push(means, variances);
    }
    if (made) show();
  }

  void stream(const Arguments& arguments) {
    arguments.expect_count(1);
    const bool flows = arguments.flag(0);
    out_.add(arguments.atoms()).send("stream");
    if (flows || !fed_) return;
    flows_ = false;
    lost_ = true;
    run();
  }
  void walking(const Arguments& arguments) {
    arguments.expect_count(1);
    walking_ = arguments.flag(0);
    if (synthesiser_) synthesiser_->set_walking(walking_);
    out_.add(arguments.atoms()).send("walking");
  }
  // Where the walk is that the frames come from: it goes on from there.
  void place(const Arguments& arguments) {
    if (!ready_for_frame()) return;
    if (!arguments.read(place_) ||
        !synthesiser_->set_place(place_[0], place_[1], std::span<const float>(place_).subspan(2)))
      slow_error().say([&] {
        return std::string(box().name()) + ": place: expected phase, cadence and " +
               std::to_string(place_.size() - 2) + " weights, got " +
               std::to_string(arguments.size()) + " numbers";
      });
  }

  void bang(const Arguments&) {
    flows_ = false;
    go_on();
  }
  void advance(const Arguments& arguments) {
    arguments.expect_count(1);
    const double seconds = arguments.number(0, 0, longest_advance);
    if (!ready_for_frame()) return;
    flows_ = false;
    const double period = 1 / model()->model->frame_rate;
    constexpr double rounding = 1e-6;  // of a frame
    for (due_ += seconds / period; due_ >= 1 - rounding; due_ -= 1) go_on();
    due_ = std::max(0.0, due_);
  }
  void start(const Arguments&) { start_or_stop(true); }
  void stop(const Arguments&) { start_or_stop(false); }
  // 1 and 0 start and stop; other numbers are labels.
  void number(const Arguments& arguments) {
    arguments.expect_count(1);
    const double value = arguments.number(0);
    if (value == 0 || value == 1)
      start_or_stop(value == 1);
    else
      queue(arguments, arguments.text(0));
  }

  void resend(const Arguments&) {
    if (delay_sent_) out_.add(*delay_sent_).send("delay");
  }
  void reset(const Arguments&) {
    if (synthesiser_) synthesiser_->reset(), synthesiser_->set_walking(walking_);
    waiting_.clear();
    fed_ = flows_ = lost_ = whole_ = false;
    due_ = 0;
    run();
    say_queue();
  }
  void dump(const Arguments&) { settings_.dump(info_); }
  void perf_message(const Arguments&) { perf().report(info_); }
  void print(const Arguments&) {
    if (!synthesiser_) {
      post("%s: waiting for %s", box().name(), model_name().c_str());
      return;
    }
    post("%s: %s, %s, past %d, future %d, %d queued", box().name(), model()->model->name.c_str(),
         !synthesiser_->alone()  ? "fed"
         : synthesiser_->walks() ? "walks alone"
                                 : "rests",
         synthesiser_->past(), synthesiser_->future(), synthesiser_->walker().queued());
  }

  // Settings, and labels by their names.
  void setting(const Arguments& arguments) {
    if (settings_.take(arguments, synthesiser_.get())) return;
    if (arguments.size() > 0) arguments.fail("no such message");
    queue(arguments, std::string(arguments.selector()));
  }

 private:
  void take(const SharedModel& shared, const SharedModel&) override {
    const Model& model = *shared->model;
    if (!shared->steps)
      throw Error("model " + model.name +
                  " was learnt without trajectory statistics, so [gait.synth] cannot walk in it; "
                  "train it again");
    auto fresh = std::make_unique<Synthesiser>(shared->model, SynthesiserSettings{}, shared->steps);
    const bool goes_on = synthesiser_ && fresh->take_over(*synthesiser_);
    synthesiser_ = std::move(fresh);
    const auto size = static_cast<std::size_t>(model.output.values);
    gauss_.assign(2 + 6 * size, 0);
    place_.assign(2 + model.styles.size(), 0);
    out_.reserve(static_cast<int>(std::max(size, synthesiser_->pose().size())));
    clock_.set_period(1000 / model.frame_rate);
    settings_.apply(*synthesiser_, goes_on,
                    [this](const char* what) { say_error(this->box(), what); });
    synthesiser_->set_walking(walking_);
    queue_waiting(model);
    if (!goes_on) fed_ = lost_ = whole_ = false, delay_sent_.reset();
    run();
  }
  void say_ready() override { info_.add_text(model_name()).send("ready"); }

  void queue_waiting(const Model& model) {
    for (const std::string& label : waiting_)
      if (const int found = label_named(model, label); found >= 0)
        synthesiser_->walker().queue(found);
      else
        say_error(
            box(),
            (std::string(box().name()) + ": no label '" + label + "' in " + model.name).c_str());
    waiting_.clear();
  }
  static int label_named(const Model& model, const std::string& name) {
    for (std::size_t i = 0; i < model.labels.size(); ++i)
      if (model.labels[i].name == name) return static_cast<int>(i);
    return -1;
  }
  void queue(const Arguments& arguments, const std::string& name) {
    if (!synthesiser_) {
      if (waiting_.size() >= LabelQueue::capacity) arguments.fail("the queue is full");
      waiting_.push_back(name);
      return;
    }
    const Model& model = *this->model()->model;
    const int label = label_named(model, name);
    if (label < 0) {
      std::string known;
      for (const Label& each : model.labels) known += (known.empty() ? "" : ", ") + each.name;
      arguments.fail("no such message, nor a label of " + model.name + ", which has " + known);
    }
    if (!synthesiser_->walker().queue(label))
      arguments.fail("the queue is full, or this label cannot follow");
    say_queue();
  }
  void say_queue() {
    const int queued = synthesiser_ ? synthesiser_->walker().queued() : 0;
    if (queued != queue_sent_) info_.add(queued).send("queue");
    queue_sent_ = queued;
  }

  void start_or_stop(bool on) {
    started_ = on;
    if (!on) lost_ = false;
    run();
  }
  // Its own clock runs when it was started, or while the stream is lost.
  void run() {
    const bool on = started_ || lost_;
    if (on == clock_.running()) return;
    if (on)
      clock_.start(model() ? 1000 / model()->model->frame_rate : 20);
    else
      clock_.stop();
  }

  void go_on() {
    if (!ready_for_frame()) return;
    bool made = false;
    {
      const Perf::Frame frame(perf());
      made = synthesiser_->go_on();
    }
    if (made) show();
  }

  void show() {
    const StepWalker& walker = synthesiser_->walker();
    if (synthesiser_->walks()) {
      whole_ = true;
      if (const auto label = walker.entered()) {
        const std::string& name = model()->model->labels[static_cast<std::size_t>(*label)].name;
        info_.add_text(name).send("step");
        if (name == "right" || name == "left") info_.add(name).send("contact");
      }
      say_queue();
      info_.add(walker.cadence()).send("cadence");
      info_.add(walker.phase()).send("phase");
    } else if (!synthesiser_->alone()) {
      whole_ = false;
      const int delay = lag_ + synthesiser_->future();
      if (delay != delay_sent_) {
        delay_sent_ = delay;
        out_.add(delay).send("delay");
      }
    }
    // Who comes to rest does so with the joints that were shown.
    if (settings_.whole_body().value_or(whole_))
      out_.add(synthesiser_->pose()).send("pose");
    else
      out_.add(synthesiser_->outputs()).send("out");
  }

  Outlet out_, info_;
  std::unique_ptr<Synthesiser> synthesiser_;
  std::vector<float> gauss_, place_;
  int lag_ = 0;
  std::optional<int> delay_sent_;
  int queue_sent_ = 0;
  double due_ = 0;  // frames that `advance` asked for and that are not whole yet

  bool fed_ = false;      // frames came
  bool flows_ = false;    // and come: its own clock waits
  bool lost_ = false;     // the stream stopped
  bool started_ = false;  // by the performer
  bool whole_ = false;    // the last frame was a whole body
  Metronome clock_{[this] {
    if (!flows_) go_on();
  }};

  SynthSetting settings_;
  std::vector<std::string> waiting_;  // labels queued before the model is there
  bool walking_ = true;
};

}  // namespace

void setup_synth() {
  if (!may_register("gait.synth")) return;
  Class<Synth>("gait.synth")
      .bang<&Synth::bang>()
      .list<&Synth::number>()
      .message<&Synth::gauss>("gauss")
      .message<&Synth::stream>("stream")
      .message<&Synth::walking>("walking")
      .message<&Synth::place>("place")
      .message<&Synth::advance>("advance")
      .message<&Synth::start>("start")
      .message<&Synth::stop>("stop")
      .message<&Synth::resend>("resend")
      .message<&Synth::reset>("reset")
      .message<&Synth::dump>("dump")
      .message<&Synth::perf_message>("perf")
      .message<&Synth::print>("print")
      .anything<&Synth::setting>();
}

}  // namespace gait::pd
