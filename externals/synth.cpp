// [gait.synth NAME]: from Gaussians to smooth frames (T14 §4.3); without them it walks by itself.
#include <cmath>

#include "gait/error.h"
#include "objects.h"
#include "pd/model_player.h"
#include "pd/ticker.h"
#include "synth_label_setting.h"
#include "synth_setting.h"

namespace gait::pd {

namespace {

constexpr double longest_advance = 60;  // seconds at once
constexpr float longest_lag = 1000;     // frames
constexpr double frames_in_gap = 3;     // after so many a frame may belong to another motion

class Synth final : public ModelPlayer<Synthesiser> {
 public:
  Synth(Box& box, const Arguments& arguments)
      : ModelPlayer(box, arguments.size() > 0 ? arguments.text(0) : ""), out_(box), info_(box) {
    arguments.expect_count(0, 1);
    join(info_);
  }

  // One frame in, one frame out.
  void gauss(const Arguments& arguments) {
    if (!ready_for_frame()) return;
    const int values = model()->model->output.values;
    if (!arguments.read(gauss_) || gauss_[1] != static_cast<float>(values)) {
      slow_error().say([&] {
        return "gauss: expected " + std::to_string(gauss_.size()) + " numbers for " +
               std::to_string(values) + " values, got " + std::to_string(arguments.size());
      });
      return;
    }
    const auto size = static_cast<std::size_t>(3 * values);
    const auto means = std::span<const float>(gauss_).subspan(2, size);
    const auto variances = std::span<const float>(gauss_).subspan(2 + size, size);
    const bool lag_fits = gauss_[0] >= 0 && gauss_[0] <= longest_lag;
    if (!lag_fits || !playing()->fits(means, variances)) {
      slow_error().say([&] {
        return "gauss: expected a lag, finite means and positive variances of what moves";
      });
      return;
    }
    const double period = 1000 / model()->model->frame_rate;
    const bool after_gap = flows_ && clock_gettimesince(fed_at_) > frames_in_gap * period;
    fed_at_ = clock_getlogicaltime();
    flows_ = fed_ = true;
    lost_ = false;
    run();
    lag_ = static_cast<int>(gauss_[0]);
    bool made = false;
    {
      const Perf::Frame frame(perf());
      made = playing()->push(means, variances, after_gap);
    }
    if (made) show();
  }

  void stream(const Arguments& arguments) {
    const bool flows = arguments.only().flag(0);
    out_.add(arguments.atoms()).send("stream");
    if (flows || !fed_) return;
    flows_ = false;
    lost_ = true;
    run();
  }
  void walking(const Arguments& arguments) {
    walking_ = arguments.only().flag(0);
    if (playing()) playing()->set_walking(walking_);
    out_.add(arguments.atoms()).send("walking");
  }
  // Where the walk of a stream is: a walk by itself continues it from there.
  void place(const Arguments& arguments) {
    if (!ready_for_frame()) return;
    if (!arguments.read(place_) ||
        !playing()->set_place(place_[0], place_[1], std::span<const float>(place_).subspan(2)))
      slow_error().say([&] {
        return "place: expected phase, cadence and " + std::to_string(place_.size() - 2) +
               " weights, got " + std::to_string(arguments.size()) + " numbers";
      });
  }

  void bang(const Arguments&) {
    flows_ = false;
    go_on();
  }
  void advance(const Arguments& arguments) {
    const double seconds = arguments.only().number(0, 0, longest_advance);
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
    const double value = arguments.only().number(0);
    if (value == 0 || value == 1)
      start_or_stop(value == 1);
    else
      queue(arguments, arguments.text(0));
  }

  void resend(const Arguments&) {
    if (delay_sent_) out_.add(*delay_sent_).send("delay");
  }
  void reset(const Arguments&) {
    if (playing()) playing()->reset(), playing()->set_walking(walking_);
    labels_.clear();
    fed_ = flows_ = lost_ = whole_ = false;
    due_ = 0;
    run();
    say_queue();
  }
  void dump(const Arguments&) { settings_.dump(info_); }
  // Settings, and labels by their names.
  void setting(const Arguments& arguments) {
    if (settings_.take(arguments, playing().get())) return;
    if (arguments.size() > 0) arguments.fail("no such message");
    queue(arguments, std::string(arguments.selector()));
  }

 private:
  void describe() override {
    post("%s: %s, %s, past %s, future %d, %d queued", box().name(), model()->model->name.c_str(),
         !playing()->alone()  ? "fed"
         : playing()->walks() ? "walks alone"
                              : "rests",
         playing()->past() == whole_past ? "all" : std::to_string(playing()->past()).c_str(),
         playing()->future(), playing()->walker().queued());
  }
  Make make() override {
    SynthesiserSettings settings;
    if (playing()) settings = {playing()->past(), playing()->future()};
    return [settings](const SharedModel& shared) {
      if (!shared->has_steps())
        throw Error("model " + shared->model->name +
                    " was learnt without trajectory statistics, so [gait.synth] cannot walk in "
                    "it; train it again");
      return std::make_shared<Synthesiser>(*shared, settings);
    };
  }
  void take(const SharedModel& shared, Synthesiser& fresh) override {
    const Model& model = *shared->model;
    const bool goes_on = playing() && fresh.take_over(*playing());
    const auto size = static_cast<std::size_t>(model.output.values);
    gauss_.assign(2 + 6 * size, 0);
    place_.assign(2 + model.styles.size(), 0);
    // Pd takes memory for a word it has not heard yet: not at frame rate.
    for (const char* word :
         {"delay", "out", "pose", "phase", "cadence", "step", "contact", "queue"})
      gensym(word);
    for (const Label& label : model.labels) gensym(label.name.c_str());
    out_.reserve(static_cast<int>(std::max(size, fresh.pose().size())));
    clock_.set_period(1000 / model.frame_rate);
    const auto failed = [this](const std::string& what) { say_error(box(), what); };
    settings_.apply(fresh, goes_on, failed);
    labels_.apply(fresh, failed);
    fresh.set_walking(walking_);
    if (!goes_on) fed_ = lost_ = whole_ = false, delay_sent_.reset();
  }
  void taken() override { run(); }

  void queue(const Arguments& arguments, const std::string& label) {
    labels_.queue(arguments, label, playing().get());
    say_queue();
  }
  void say_queue() {
    const int queued = playing() ? playing()->walker().queued() : 0;
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
      made = playing()->go_on();
    }
    if (made) show();
  }

  void show() {
    const StepWalker& walker = playing()->walker();
    if (playing()->walks()) {
      whole_ = true;
      if (const auto label = walker.entered()) {
        const std::string& name = model()->model->labels[static_cast<std::size_t>(*label)].name;
        info_.add_text(name).send("step");
        if (name == "right" || name == "left") info_.add(name).send("contact");
      }
      say_queue();
      info_.add(walker.cadence()).send("cadence");
      info_.add(walker.phase()).send("phase");
    } else if (!playing()->alone()) {
      whole_ = false;
      const int delay = lag_ + playing()->future();
      if (delay != delay_sent_) {
        delay_sent_ = delay;
        out_.add(delay).send("delay");
      }
    }
    // A walk that comes to rest does so with the joints of the frames before.
    if (settings_.whole_body().value_or(whole_))
      out_.add(playing()->pose()).send("pose");
    else
      out_.add(playing()->outputs()).send("out");
  }

  Outlet out_, info_;
  std::vector<float> gauss_, place_;
  int lag_ = 0;
  std::optional<int> delay_sent_;
  int queue_sent_ = 0;
  double due_ = 0;  // frames that `advance` asked for and that are not whole yet

  bool fed_ = false;      // frames came
  bool flows_ = false;    // and come: its own clock waits
  double fed_at_ = 0;     // Pd's logical time
  bool lost_ = false;     // the stream stopped
  bool started_ = false;  // by the performer
  bool whole_ = false;    // the last frame was a whole body
  Metronome clock_{[this] {
    if (!flows_) go_on();
  }};

  SynthSetting settings_;
  LabelSetting labels_;
  bool walking_ = true;
};

}  // namespace

void setup_synth() {
  Class<Synth>("gait.synth")
      .walker()
      .messages<&Synth::gauss, &Synth::stream, &Synth::walking, &Synth::place, &Synth::resend>(
          {"gauss", "stream", "walking", "place", "resend"})
      .common()
      .anything<&Synth::setting>();
}

}  // namespace gait::pd
