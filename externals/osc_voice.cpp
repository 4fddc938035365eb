#include "osc_voice.h"

#include <algorithm>
#include <numbers>

#include "gait/osc/forms.h"
#include "gait/osc/receiver.h"

namespace gait::pd {

namespace {

constexpr double longest_wait = 1;  // seconds, for the frame of a calibration
constexpr std::size_t head = 5;     // of a waiting frame: posed, x y z, heading

}  // namespace

OscVoice::OscVoice(std::shared_ptr<const Model> model, int number, const OscSettings& settings)
    : model_(std::move(model)),
      number_(number),
      body_(model_),
      waiting_(static_cast<int>(head) + static_cast<int>(model_->inputs.size()) +
               values_of(model_->inputs) + (model_->body ? 3 * model_->body->skeleton.size() : 0)),
      there_(model_->inputs.size(), true),
      inputs_(static_cast<std::size_t>(values_of(model_->inputs))),
      pose_(model_->body ? 3 * model_->body->skeleton.joints.size() : 0) {
  packed_.resize(head + there_.size() + inputs_ + pose_);
  set(settings);
}

void OscVoice::set(const OscSettings& settings) {
  body_.set_yaw(settings.yaw * std::numbers::pi / 180);
  body_.set_hold(settings.hold);
  body_.set_smoothing(settings.smooth);
  waiting_.set_delay(settings.jitter / 1000);
  hold_ = settings.hold;
}

bool OscVoice::calibrate(CalibrationPose pose, double now) {
  if (!flowing_) return false;
  body_.calibrate(pose, now + longest_wait);
  return true;
}

void OscVoice::reset() {
  body_.reset();
  waiting_.reset();
}

void OscVoice::take_over(const OscVoice& before) {
  body_.take_over(before.body_);
  sender_ = before.sender_, stream_ = before.stream_, form_ = before.form_;
  changed_sender_ = before.changed_sender_;
  flowing_ = before.flowing_, said_flowing_ = before.said_flowing_;
  last_ = before.last_;
  for (std::size_t i = 0; i < there_.size(); ++i)
    for (std::size_t j = 0; j < before.there_.size(); ++j)
      if (model_->inputs[i].name == before.model_->inputs[j].name) there_[i] = before.there_[j];
}

void OscVoice::end(Outlet& info) {
  waiting_.reset();
  flowing_ = false;
  if (!said_flowing_) return;
  said_flowing_ = false;
  to(info, "stream").add(0).send();
}

void OscVoice::take(const osc::CapturedFrame& frame) noexcept {
  // The same program may open another port for every take: the calibration holds on.
  const bool same_performer =
      frame.form == form_ && frame.stream == stream_ && frame.sender.host == sender_.host;
  if (!same_performer || frame.begun) {
    if (same_performer)
      body_.forget_pose();
    else
      body_.reset();
    changed_sender_ = true;
  }
  sender_ = frame.sender, stream_ = frame.stream, form_ = frame.form;
  if (!body_.take(frame)) {
    ++unfit_;
    return;
  }
  const osc::LiveFrame& live = body_.frame();
  packed_[0] = live.posed ? 1 : 0;
  std::copy_n(live.hips.data(), 3, packed_.begin() + 1);
  packed_[4] = live.heading;
  auto at = packed_.begin() + head;
  for (std::size_t i = 0; i < there_.size(); ++i)
    *at++ = body_.there(static_cast<int>(i)) ? 1.0f : 0.0f;
  at = std::copy(live.inputs.begin(), live.inputs.end(), at);
  std::copy(live.pose.begin(), live.pose.end(), at);
  waiting_.push(frame.time, packed_, frame.sent);
  last_ = frame.time;
  flowing_ = true;
  ++counted_;
}

void OscVoice::send_masks(Outlet& in, std::span<const float> there) {
  for (std::size_t i = 0; i < there.size(); ++i) {
    if ((there[i] != 0) == there_[i]) continue;
    there_[i] = !there_[i];
    to(in, "mask").add(model_->inputs[i].name).add(there_[i] ? 1 : 0).send();
  }
}

void OscVoice::send_sender(Outlet& info) {
  info.add(std::max(0, number_)).add(sender_.name()).send("performer");
  to(info, "form").add(std::string(osc::form_name(form_))).send();
}

void OscVoice::release(double now, Outlet& in, Outlet& pose, Outlet& info, Perf& perf,
                       Latency& latency) {
  const auto frame = waiting_.pop(now);
  if (frame.empty()) return;
  const Perf::Frame measured(perf);
  latency.add(osc::Receiver::now() - waiting_.arrival());
  if (changed_sender_) {
    changed_sender_ = false;
    send_sender(info);
  }
  if (!said_flowing_) {
    said_flowing_ = true;
    rate_from_ = 0;
    to(info, "stream").add(1).send();
  }
  if (frame[0] != 0 && pose_ > 0) {
    to(pose, "root").add(frame.subspan(1, 4)).send();
    to(pose, "pose").add(frame.subspan(head + there_.size() + inputs_)).send();
  }
  send_masks(in, frame.subspan(head, there_.size()));
  to(in, "in").add(frame.subspan(head + there_.size(), inputs_)).send();
}

void OscVoice::report(double now, Outlet& info) {
  if (flowing_ && said_flowing_ && now - last_ > hold_ && waiting_.waiting() == 0) {
    end(info);
  }
  if (!flowing_) {
    rate_from_ = 0;
    return;
  }
  if (rate_from_ == 0) {
    rate_from_ = last_;
    counted_ = 0;
  } else if (last_ - rate_from_ >= 1) {
    to(info, "rate").add(counted_ / (last_ - rate_from_)).send();
    rate_from_ = last_;
    counted_ = 0;
  }
}

}  // namespace gait::pd
