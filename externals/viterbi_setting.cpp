#include "viterbi_setting.h"

#include <algorithm>

#include "pd/named_argument.h"

namespace gait::pd {

namespace {

constexpr double longest = 60;  // seconds

}  // namespace

void ViterbiSetting::decoder(const Arguments& arguments) {
  arguments.expect_count(1, 2);
  const std::string kind = arguments.symbol(0);
  if (kind != "viterbi" && kind != "forward" && kind != "lag")
    arguments.fail_at(0, "viterbi, forward or lag");
  arguments.expect_count(kind == "lag" ? 2 : 1);
  if (kind == "lag") recognising_.lag = arguments.number(1, 0, 2);
  recognising_.decoder = kind == "viterbi"   ? DecoderKind::viterbi
                         : kind == "forward" ? DecoderKind::forward
                                             : DecoderKind::lag;
}

void ViterbiSetting::mask(const Arguments& arguments, const Model* model) {
  arguments.expect_count(2);
  const bool there = arguments.flag(1);
  const std::string input = arguments.text(0);
  if (input == "all") {
    masks_.clear();
    if (there) return;
  } else if (model) {
    named_argument(arguments, 0, model->inputs, "input");
  }
  std::erase_if(masks_, [&](const Mask& mask) { return mask.input == input; });
  masks_.push_back({input, there});
}

void ViterbiSetting::on_lost(const Arguments& arguments) {
  arguments.expect_count(1, 2);
  const std::string what = arguments.symbol(0);
  if (what != "walk" && what != "stop") arguments.fail_at(0, "walk or stop");
  std::optional<double> seconds;
  if (arguments.size() == 2) seconds = arguments.number(1, 0, 3600);
  walks_on_ = what == "walk";
  lost_seconds_ = seconds;
  going_on_ = seconds;
  if (!walks_on_ && !seconds) going_on_ = 0;
}

void ViterbiSetting::rate(const Arguments& arguments) {
  rate_ = arguments.only().number(0, 0, 1000);
}
void ViterbiSetting::memory(const Arguments& arguments) {
  memory_ = static_cast<float>(arguments.only().number(0, 0, longest));
}
void ViterbiSetting::margin(const Arguments& arguments) {
  margin_ = static_cast<float>(arguments.only().number(0, 0, 1));
}
void ViterbiSetting::hold(const Arguments& arguments) {
  hold_ = arguments.only().number(0, 0, longest);
}
void ViterbiSetting::timeout(const Arguments& arguments) {
  timeout_ = arguments.only().number(0, 0.02, longest);
}

void ViterbiSetting::ahead(const Arguments& arguments) {
  ahead_ = arguments.only().number(0, 0, 200) / 1000;
}

std::vector<std::string> ViterbiSetting::forget_unknown(const Model& model) {
  std::vector<std::string> unknown;
  for (const Mask& mask : masks_)
    if (mask.input != "all" && index_said(model.inputs, mask.input) < 0)
      unknown.push_back(mask.input);
  std::erase_if(masks_, [&](const Mask& mask) {
    return std::ranges::find(unknown, mask.input) != unknown.end();
  });
  return unknown;
}

void ViterbiSetting::apply(LiveRecogniser& live, const Model& model) const {
  std::vector<bool> missing(model.inputs.size(), false);
  for (const Mask& mask : masks_) {
    const int input = index_said(model.inputs, mask.input);
    if (mask.input == "all")
      missing.assign(missing.size(), !mask.there);
    else if (input >= 0)
      missing[static_cast<std::size_t>(input)] = !mask.there;
  }
  for (std::size_t i = 0; i < missing.size(); ++i)
    live.set_missing(static_cast<int>(i), missing[i]);
  live.set_style_memory(memory_.value_or(static_cast<float>(model.play.style_memory)));
  live.choice().set_margin(margin_);
  live.choice().set_hold(hold_);
}

void ViterbiSetting::dump(Outlet& info) const {
  if (recognising_.decoder) {
    const DecoderKind kind = *recognising_.decoder;
    info.add(kind == DecoderKind::viterbi   ? "viterbi"
             : kind == DecoderKind::forward ? "forward"
                                            : "lag");
    if (kind == DecoderKind::lag) info.add(recognising_.lag.value_or(0));
    info.send("decoder");
  }
  info.add(rate_).send("rate");
  if (memory_) info.add(*memory_).send("memory");
  info.add(margin_).send("margin");
  info.add(hold_).send("hold");
  info.add(timeout_).send("timeout");
  info.add(1000 * ahead_).send("ahead");
  info.add(walks_on_ ? "walk" : "stop");
  if (lost_seconds_) info.add(*lost_seconds_);
  info.send("onlost");
  info.add("all").add(1).send("mask");
  for (const Mask& mask : masks_) info.add_text(mask.input).add(mask.there ? 1 : 0).send("mask");
}

}  // namespace gait::pd
