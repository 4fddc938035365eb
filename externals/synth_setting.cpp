#include "synth_setting.h"

#include "gait/error.h"

namespace gait::pd {

namespace {

const char* name_of(OnLost what) {
  return what == OnLost::walk ? "walk" : what == OnLost::hold ? "hold" : "stop";
}

int past_frames(const Arguments& past) {
  if (!past.is_symbol(0)) return past.integer(0, 0, Synthesiser::longest_past);
  if (past.symbol(0) != "all") past.fail_at(0, "a number of frames, or all");
  return whole_past;
}

}  // namespace

bool SynthSetting::take(const Arguments& arguments, Synthesiser* synthesiser) {
  if (arguments.selector() == "joint") {
    joints_.take(arguments, synthesiser);
    return true;
  }
  if (take_styles(arguments, synthesiser)) return true;
  if (!take_number(arguments) && !take_word(arguments)) return false;
  if (synthesiser) set_numbers(*synthesiser);
  return true;
}

bool SynthSetting::take_styles(const Arguments& arguments, Synthesiser* synthesiser) {
  const StyleSetting before = styles_;
  if (!styles_.take(arguments, synthesiser ? &synthesiser->model() : nullptr)) return false;
  if (!synthesiser) return true;
  const Model& model = synthesiser->model();
  if (synthesiser->walker().set_weights(styles_.weights(model))) return true;
  styles_ = before;
  arguments.fail("expected styles that " + model.name + " has steps of");
}

bool SynthSetting::take_number(const Arguments& arguments) {
  const auto selector = arguments.selector();
  if (selector == "auto") {
    auto_ = arguments.only().flag(0);
  } else if (selector == "cadence") {
    cadence_ = static_cast<float>(arguments.only().number(0, 0, 10));
  } else if (selector == "past") {
    past_ = past_frames(arguments.only());
  } else if (selector == "future") {
    future_ = arguments.only().integer(0, 0, Synthesiser::longest_future);
  } else if (selector == "duration") {
    arguments.expect_count(2);
    const std::string what = arguments.symbol(0);
    if (what == "scale")
      scale_ = static_cast<float>(arguments.number(1, 0.1, 10));
    else if (what == "shift")
      shift_ = static_cast<float>(arguments.number(1, -10, 10));
    else if (what == "fix" && arguments.number(1) == 0)
      fixed_ = 0;  // as the model has it
    else if (what == "fix")
      fixed_ = static_cast<float>(arguments.number(1, 0.1, 60));
    else
      arguments.fail_at(0, "scale, shift or fix");
  } else {
    return false;
  }
  return true;
}

bool SynthSetting::take_word(const Arguments& arguments) {
  if (arguments.selector() == "onlost") {
    const std::string what = arguments.only().symbol(0);
    if (what == "walk")
      on_lost_ = OnLost::walk;
    else if (what == "hold")
      on_lost_ = OnLost::hold;
    else if (what == "stop")
      on_lost_ = OnLost::stop;
    else
      arguments.fail_at(0, "walk, hold or stop");
  } else if (arguments.selector() == "body") {
    const std::string what = arguments.only().symbol(0);
    if (what != "out" && what != "pose") arguments.fail_at(0, "out or pose");
    whole_body_ = what == "pose";
  } else {
    return false;
  }
  return true;
}

// Sets all of them: setting the same value again has no effect.
void SynthSetting::set_numbers(Synthesiser& synthesiser) const {
  synthesiser.walker().set_auto(auto_);
  LabelDurations& durations = synthesiser.walker().durations();
  durations.set_scale(scale_);
  durations.set_shift(shift_);
  durations.fix(fixed_);
  durations.set_cadence(cadence_);
  synthesiser.set_on_lost(on_lost_);
  if (past_ && *past_ != synthesiser.past()) synthesiser.set_past(*past_);
  if (future_ && *future_ != synthesiser.future()) synthesiser.set_future(*future_);
}

void SynthSetting::apply(Synthesiser& synthesiser, bool goes_on,
                         const std::function<void(const std::string&)>& failed) {
  set_numbers(synthesiser);
  joints_.apply(synthesiser, failed);
  if (goes_on) return;
  try {
    const std::vector<float> weights = styles_.weights(synthesiser.model());
    if (!weights.empty() && !synthesiser.walker().set_weights(weights))
      throw Error("expected styles that " + synthesiser.model().name + " has steps of");
  } catch (const Error& error) {
    failed(std::string("gait.synth: style: ") + error.what());
    styles_.clear();
  }
}

void SynthSetting::dump(Outlet& info) const {
  styles_.dump(info);
  info.add(auto_ ? 1 : 0).send("auto");
  info.add("scale").add(scale_).send("duration");
  info.add("shift").add(shift_).send("duration");
  info.add("fix").add(fixed_).send("duration");
  info.add(cadence_).send("cadence");
  joints_.dump(info);
  if (past_ == whole_past)
    info.add("all").send("past");
  else if (past_)
    info.add(*past_).send("past");
  if (future_) info.add(*future_).send("future");
  info.add(name_of(on_lost_)).send("onlost");
  if (whole_body_) info.add(*whole_body_ ? "pose" : "out").send("body");
}

}  // namespace gait::pd
