// [gait.viterbi~ NAME -signals n | -mc]: recognises steps and style (T14) in frames that come as
// messages or signals, and runs a phase clock beside the walk.
#include <cmath>

#include "gait/model/label_cycle.h"
#include "gait/play/input/sender_clock.h"
#include "gait/play/map/observation_message.h"
#include "gait/play/recognise/live_recogniser.h"
#include "objects.h"
#include "pd/model_player.h"
#include "pd/multichannel.h"
#include "pd/phase_signals.h"
#include "viterbi_setting.h"
#include "viterbi_signal_input.h"
#include "viterbi_single_inputs.h"

namespace gait::pd {

namespace {

constexpr double falling_in = 2;  // seconds: so long `place` goes out with a new stream's frames

// What plays a model here.
struct Recognising {
  Recognising(const PlayModel& played, const RecogniserSettings& with)
      : model(played),
        live(model, with),
        settings(with),
        observation(*model.model),
        in(static_cast<std::size_t>(model.model->input.values), 0.0f),
        pose(model.model->body ? 3 * model.model->body->references.size() : 0, 0.0f) {}
  PlayModel model;
  LiveRecogniser live;
  RecogniserSettings settings;
  ObservationMessage observation;
  std::vector<float> in, pose;
};

class Viterbi final : public ModelPlayer<Recognising> {
 public:
  Viterbi(Box& box, const Arguments& arguments)
      : ModelPlayer(box, arguments.is_word(0) ? arguments.text(0) : ""),
        signals_(box, [this](int step) { touch(step); }),
        message_(box),
        info_(box) {
    int at = arguments.is_word(0) ? 1 : 0;
    while (at < arguments.size()) {
      const std::string flag = arguments.symbol(at++);
      if (flag == "-signals" && signal_input_.inlets() == 0)
        signal_input_.make_inlets(arguments.integer(at++, 1, 512));
      else if (flag == "-mc" && signal_input_.inlets() == 0)
        signal_input_.make_multichannel();
      else
        arguments.fail_at(at - 1, "-signals N or -mc");
    }
    join(info_);
  }

  void in(const Arguments& arguments) { whole_frame(arguments, false); }
  // A phone's stream from [gait.osc], with its name first.
  void plain(const Arguments& arguments) {
    if (arguments.size() < 1) arguments.fail("expected a name and numbers");
    const auto atoms = arguments.atoms().subspan(1);
    in(Arguments(box().name(), "plain", static_cast<int>(atoms.size()), atoms.data()));
  }
  void pose(const Arguments& arguments) { whole_frame(arguments, true); }
  void list(const Arguments& arguments) {
    whole_frame(arguments,
                playing() && arguments.size() == static_cast<int>(playing()->pose.size()));
  }

  template <void (*Set)(const Arguments&, const Model&, InputStream&)>
  void single(const Arguments& arguments) {
    if (ready_for_frame()) Set(arguments, *model()->model, live().stream());
  }
  void bang(const Arguments&) {
    if (!ready_for_frame()) return;
    arrived(live().stream().push_collected(time_of_frame()), "bang");
  }

  void decoder(const Arguments& arguments) {
    settings_.decoder(arguments);
    follow_decoder();
  }
  void mask(const Arguments& arguments) {
    settings_.mask(arguments, model() ? model()->model.get() : nullptr);
    if (playing()) settings_.apply(live(), *model()->model);
  }
  template <void (ViterbiSetting::*Set)(const Arguments&)>
  void set(const Arguments& arguments) {
    (settings_.*Set)(arguments);
    if (playing()) settings_.apply(live(), *model()->model);
    sender_.set_rate(settings_.rate());
    signals_.clock().set_ahead(settings_.ahead());
  }
  void resend(const Arguments&) {
    tell(streaming_, "stream");
    if (streaming_) tell(walking_, "walking");
  }

  void reset(const Arguments&) {
    if (playing()) live().reset();
    sender_.reset();
    signals_.clock().reset();
    step_ = style_ = -1;
  }
  void dump(const Arguments&) { settings_.dump(info_); }
  void dsp(t_signal** signals) {
    const int inlets = signal_input_.inlets();
    for (int i = 0; i < PhaseSignals::outlets; ++i) make_single(&signals[inlets + i]);
    signal_input_.dsp(signals);
    signals_.dsp(signals, inlets);
  }

 private:
  Make make() override {
    return [settings = settings_.recognising()](const SharedModel& model) {
      return std::make_shared<Recognising>(*model, settings);
    };
  }
  void take(const SharedModel& model, Recognising& fresh) override {
    for (const std::string& unknown : settings_.forget_unknown(*model->model))
      complain(box(), "mask: no input '" + unknown + "' in " + model_name());
    begin(fresh, *model->model);
  }
  void describe() override {
    const Model& learnt = *model()->model;
    post("%s: recognises with %s, %d frames late; %s, %s, label %s, phase %.3f", box().name(),
         model_name().c_str(), live().recogniser().lag(), streaming_ ? "streaming" : "no stream",
         walking_ ? "walking" : "standing", learnt.labels[live().decision().label].name.c_str(),
         static_cast<double>(live().decision().phase));
  }
  // `decoder` may have come while the worker made another one.
  void taken() override { follow_decoder(); }

  // Recognises as the settings say, where the decoder is another.
  void follow_decoder() {
    if (!playing() || settings_.same_recogniser(playing()->settings)) return;
    auto fresh = std::make_shared<Recognising>(playing()->model, settings_.recognising());
    begin(*fresh, *fresh->model.model);
    play(std::move(fresh));
  }
  void begin(Recognising& fresh, const Model& learnt) {
    settings_.apply(fresh.live, learnt);
    message_.reserve(fresh.observation.longest());
    info_.reserve(static_cast<int>(learnt.styles.size()) + 8);
    signal_input_.set_rate(learnt.frame_rate);
    signals_.replace(fresh.live.recogniser().clock_settings());
    signals_.clock().set_ahead(settings_.ahead());
    steps_ = labels_in_step(learnt);
    sender_.reset();
    step_ = style_ = -1;
  }
  LiveRecogniser& live() { return playing()->live; }

  double now() const { return clock_gettimesince(begin_) / 1000; }
  double time_of_frame() { return sender_.time_of_arrival(now()); }

  void whole_frame(const Arguments& arguments, bool body) {
    if (!ready_for_frame()) return;
    const std::span<float> values(body ? playing()->pose : playing()->in);
    const char* const what = arguments.selector().data();
    if (values.empty() || !arguments.read(values)) {
      refuse(what, arguments.size(), body);
      return;
    }
    const double time = time_of_frame();
    arrived(body ? live().stream().push_body(time, values) : live().stream().push(time, values),
            what);
  }
  void signal_frame(double time, std::span<const float> values) {
    if (!ready_for_frame()) return;
    const bool body = values.size() != playing()->in.size();
    if (body && values.size() != playing()->pose.size()) {
      refuse("signals", static_cast<int>(values.size()), false);
      return;
    }
    arrived(body ? live().stream().push_body(time, values) : live().stream().push(time, values),
            "signals");
  }
  void refuse(const char* what, int count, bool body) {
    perf().drop();
    slow_error().say([&] {
      const std::string in = std::to_string(playing()->in.size()),
                        pose = std::to_string(playing()->pose.size());
      const std::string expected = what == std::string_view("in") ? in
                                   : body                         ? pose
                                   : playing()->pose.empty()      ? in
                                                                  : in + " or " + pose;
      return std::string(what) + ": expected " + expected + " numbers, got " +
             std::to_string(count);
    });
  }

  void arrived(FrameClock::Arrival arrival, const char* what) {
    if (arrival == FrameClock::Arrival::rejected) {
      perf().drop();
      slow_error().say([&] {
        return std::string(what) +
               ": expected finite numbers, at a time after the frame before's (who sends frames "
               "together says their rate)";
      });
      return;
    }
    lost_.after(1000 * settings_.timeout());
    if (!streaming_) {
      streaming_ = true;
      told_places_ = 0;
      step_ = style_ = -1;  // the first step and style go out even if they are the last ones
      stop_.cancel();
      tell(true, "stream");
    }
    // A message sent may come back and change the model here: then no more frames are sent.
    const std::shared_ptr<Recognising> now = playing();
    while (now == playing() && next(now->live)) decided(*now);
  }
  // Measures the recogniser's time, without that of the objects which receive its messages.
  bool next(LiveRecogniser& live) {
    Perf::Frame frame(perf());
    const bool made = live.next();
    if (!made) frame.forget();
    return made;
  }

  // Right to left: info, then what goes to the map.
  void decided(Recognising& now) {
    const LiveRecogniser& live = now.live;
    const Model& learnt = live.recogniser().model();
    const Decision& decision = live.decision();
    signals_.keep_going();
    if (live.first_of_run() || live.walking() != walking_) {
      walking_ = live.walking();
      signals_.clock().set_walking(walking_);
      tell(walking_, "walking");
    }
    const PhaseEstimate& estimate = live.recogniser().phase_estimate();
    signals_.clock().observe(estimate.seen, estimate.certainty, live.estimate_late());
    info_.add(1000 * live.decision_late()).send("latency");
    info_.add(live.unlike()).send("unlike");
    const std::span<const float> styles = live.recogniser().styles();
    if (live.style() != style_ && live.style() >= 0) {
      style_ = live.style();
      info_.add_text(learnt.styles[style_]).add(styles[style_]).send("style");
    }
    if (!styles.empty()) info_.add(styles).send("styles");
    info_.add_text(learnt.labels[decision.label].name)
        .add(decision.state)
        .add(decision.log_likelihood)
        .send("state");
    // What was never taught is no gesture; of a walk, any walk is one.
    const int step = !learnt.body && live.strange() ? nothing_taught : decision.label;
    if (walking_ && !ahead_of_steps()) tell_step(step, learnt);
    info_.add(decision.cadence).send("cadence");
    info_.add(decision.phase).send("phase");
    // A walk by itself falls in step with a new stream before it changes over to it.
    if (told_places_ < falling_in * learnt.frame_rate) {
      ++told_places_;
      message_.add(decision.phase).add(decision.cadence).add(styles).send("place");
    }
    message_.add(now.observation.write(live.recogniser())).send("obs");
  }

  // Contacts come from the clock. Where it runs ahead, so do steps.
  void touch(int step) {
    if (playing() && ahead_of_steps())
      tell_step(steps_[static_cast<std::size_t>(step)], *model()->model);
    info_.add(step % 2 == 0 ? "right" : "left").send("contact");
  }
  bool ahead_of_steps() const { return settings_.ahead() > 0 && !steps_.empty(); }
  void tell_step(int step, const Model& learnt) {
    if (step == step_) return;
    step_ = step;
    const bool taught = step != nothing_taught;
    info_.add_text(taught ? learnt.labels[static_cast<std::size_t>(step)].name : "null")
        .send("step");
  }
  // The label of each step of the cycle; empty where labels form no single cycle.
  static std::vector<int> labels_in_step(const Model& learnt) {
    const std::vector<LabelCycle> cycles = label_cycles(learnt);
    if (cycles.front().labels != static_cast<int>(cycles.size())) return {};
    std::vector<int> labels(cycles.size());
    for (std::size_t label = 0; label < cycles.size(); ++label)
      labels[static_cast<std::size_t>(cycles[label].index)] = static_cast<int>(label);
    return labels;
  }

  void tell(bool on, const char* selector) {
    info_.add(on ? 1 : 0).send(selector);
    message_.add(on ? 1 : 0).send(selector);
  }

  // No frame came for too long.
  void lost() {
    if (!streaming_) return;
    signals_.keep_going();
    streaming_ = false;
    const PhaseClock& clock = signals_.clock();
    // Where the body was, not where the clock runs ahead of it.
    const double phase = clock.phase() - clock.ahead() * clock.frequency();
    message_.add(phase - std::floor(phase)).add(clock.cadence());
    message_.add(live().recogniser().styles());
    message_.send("place");
    tell(false, "stream");
    live().reset();
    sender_.reset();
    if (const auto seconds = settings_.going_on()) {
      if (*seconds > 0)
        stop_.after(1000 * *seconds);
      else
        signals_.clock().set_walking(false);
    }
  }

  PhaseSignals signals_;
  Outlet message_, info_;
  ViterbiSetting settings_;
  SenderClock sender_;
  SignalInput signal_input_{
      box(), [this](double time, std::span<const float> values) { signal_frame(time, values); }};
  const double begin_ = clock_getlogicaltime();
  bool streaming_ = false, walking_ = false;
  int told_places_ = 0;  // since the stream began
  static constexpr int nothing_taught = -2;
  int step_ = -1, style_ = -1;  // sent last
  std::vector<int> steps_;      // label of each step of the cycle; empty: none
  Ticker lost_{[this] { lost(); }};
  Ticker stop_{[this] { signals_.clock().set_walking(false); }};
};

}  // namespace

void setup_viterbi() {
  Class<Viterbi>("gait.viterbi~", multichannel_class)
      .messages<&Viterbi::in, &Viterbi::pose, &Viterbi::plain, &Viterbi::single<&set_joint>,
                &Viterbi::single<&set_quaternion>, &Viterbi::single<&set_euler>>(
          {"in", "pose", "plain", "joint", "quat", "euler"})
      .bang<&Viterbi::bang>()
      .list<&Viterbi::list>()
      .messages<&Viterbi::decoder, &Viterbi::mask, &Viterbi::set<&ViterbiSetting::rate>,
                &Viterbi::set<&ViterbiSetting::memory>, &Viterbi::set<&ViterbiSetting::margin>,
                &Viterbi::set<&ViterbiSetting::hold>, &Viterbi::set<&ViterbiSetting::timeout>,
                &Viterbi::set<&ViterbiSetting::ahead>, &Viterbi::set<&ViterbiSetting::on_lost>,
                &Viterbi::resend>({"decoder", "mask", "rate", "memory", "margin", "hold", "timeout",
                                   "ahead", "onlost", "resend"})
      .common()
      .refuse_others()
      .dsp();
}

}  // namespace gait::pd
