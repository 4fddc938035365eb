// [gait.phase~]: a phase clock that follows phases, contacts, foot switches or taps.
#include <cmath>

#include "objects.h"
#include "pd/phase_signals.h"

namespace gait::pd {

namespace {

class Phase {
 public:
  Phase(Box& box, const Arguments& arguments)
      : box_(box), signals_(box, [this](int step) { contact_passed(step); }), info_(box) {
    arguments.expect_count(0);
  }

  void phase(const Arguments& arguments) {
    const double phase = arguments.only().number(0);
    clock().observe(phase - std::floor(phase));
  }
  void cadence(const Arguments& arguments) {
    cadence_ = arguments.only().number(0, 0.1, 20);
    clock().set_cadence(cadence_);
  }
  void contact(const Arguments& arguments) {
    const std::string foot = arguments.only().symbol(0);
    if (foot != "right" && foot != "left") arguments.fail_at(0, "right or left");
    clock().observe_contact(foot == "right" ? 0 : 1);
  }
  void walking(const Arguments& arguments) { clock().set_walking(arguments.only().flag(0)); }
  void pull(const Arguments& arguments) {
    pull_ = arguments.only().number(0, 0, 10);
    clock().set_pull(pull_);
  }
  void ahead(const Arguments& arguments) {
    clock().set_ahead(arguments.only().number(0, 0, 200) / 1000);
  }
  void tap(const Arguments&) { clock().tap(); }
  void reset(const Arguments&) { clock().reset(); }
  void dump(const Arguments&) {
    info_.add(cadence_).send("cadence");
    info_.add(pull_).send("pull");
    info_.add(1000 * clock().ahead()).send("ahead");
    info_.add(clock().walking() ? 1 : 0).send("walking");
  }
  void report_perf(const Arguments&) { signals_.report(info_); }
  void print(const Arguments&) {
    post("%s: phase %.3f, %.2f steps per second, %s", box_.name(),
         static_cast<double>(clock().phase()), static_cast<double>(clock().cadence()),
         clock().walking() ? "walking" : "standing");
  }
  void dsp(t_signal** signals) { signals_.dsp(signals); }

 private:
  void contact_passed(int step) {
    info_.add(clock().cadence()).send("cadence");
    info_.add(step == 0 ? "right" : "left").send("step");
    info_.add(step == 0 ? "right" : "left").send("contact");
  }
  PhaseClock& clock() { return signals_.clock(); }

  Box& box_;
  PhaseSignals signals_;
  Outlet info_;
  double cadence_ = 1.8, pull_ = 1;
};

}  // namespace

void setup_phase() {
  Class<Phase>("gait.phase~")
      .messages<&Phase::phase, &Phase::cadence, &Phase::contact, &Phase::walking, &Phase::pull,
                &Phase::ahead, &Phase::tap>(
          {"phase", "cadence", "contact", "walking", "pull", "ahead", "tap"})
      .common()
      .refuse_others()
      .dsp();
}

}  // namespace gait::pd
