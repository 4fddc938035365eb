#include "live_monitor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "gait/osc/forms.h"

namespace gait::tool {

namespace {

constexpr float least_turn = 1e-4F;  // of a quaternion's entry; sensors never stand still
constexpr double still_for = 3;      // seconds

}  // namespace

std::string bone_list(const std::bitset<humanoid_bones>& bones) {
  std::string text;
  for (int bone = 0; bone < humanoid_bones; ++bone)
    if (bones[static_cast<std::size_t>(bone)])
      text += (text.empty() ? "" : ", ") + std::string(bone_name(bone));
  return text;
}

void LiveMonitor::frame(int performer, const osc::CapturedFrame& frame) noexcept {
  Seen& seen = seen_[performer];
  if (frame.begun) seen = {};
  if (seen.first == 0) seen.first = seen.moved = frame.time;
  if (seen.last > 0) seen.longest = std::max(seen.longest, frame.time - seen.last);
  seen.last = frame.time;
  bool moved = frame.joints > 0 || frame.values > 0;
  for (std::size_t bone = 0; bone < humanoid_bones; ++bone) {
    for (std::size_t i = 0; i < 4; ++i)
      moved = moved || (frame.rotated[bone] &&
                        std::abs(frame.rotations[bone][i] - seen.rotations[bone][i]) > least_turn);
    for (std::size_t i = 0; i < 3; ++i)
      moved = moved || (frame.placed[bone] &&
                        std::abs(frame.places[bone][i] - seen.places[bone][i]) > least_turn);
  }
  if (moved) seen.moved = frame.time;
  seen.rotations = frame.rotations;
  seen.places = frame.places;
  const std::array<float, 3> nowhere{};
  if ((frame.placed[0] && frame.places[0] != nowhere) ||
      (frame.root_told && frame.root != nowhere) || frame.joints > 0)
    seen.placed = frame.time;
}

void LiveMonitor::plain(const osc::MocapEvent& event) {
  if (event.first == 0)
    ++plain_[event.sender.name() + " " + std::string(osc::form_name(event.form)) + " plain " +
             event.name.data() + ", " + std::to_string(event.total) + " numbers"];
}

std::vector<std::string> LiveMonitor::doubts(double now, const osc::FrameSource& source,
                                             const Seen& seen) {
  std::vector<std::string> doubts;
  const osc::CapturedFrame& frame = source.frame();
  const osc::FormSpace space = osc::facts_of(frame.form).space;
  const bool humanoid = space != osc::FormSpace::own;
  const auto bones = source.bones();
  const auto has = [&](gait::Bone bone) { return bones[index_of(bone)]; };
  if (humanoid && space != osc::FormSpace::camera) {
    if (!has(gait::Bone::hips))
      doubts.emplace_back("no Hips: no body can be recorded, and a model with hips misses them");
    if (seen.last > 0 && seen.last - seen.placed > 1)
      doubts.emplace_back("no place of the hips: the body will not travel");
  }
  if (humanoid && !has(gait::Bone::left_upper_leg) && !has(gait::Bone::right_upper_leg))
    doubts.emplace_back(has(gait::Bone::left_upper_arm) || has(gait::Bone::right_upper_arm)
                            ? "no legs"
                            : "neither arms nor legs: a face tracker?");
  if (space == osc::FormSpace::judged && frame.placed[0] && frame.places[0][2] > 0.6F &&
      std::abs(frame.places[0][1]) < 0.4F)
    doubts.emplace_back("the hips' height seems to be along Z: set the sender to Y up");
  if (seen.last > 0 && now - seen.first > still_for && seen.last - seen.moved > still_for)
    doubts.emplace_back("nothing moves");
  if (source.rate() > 0 && source.rate() < 20) doubts.emplace_back("slow: less than 20 a second");
  if (seen.longest > 0.05 && source.uneven() > 2) {
    char text[80];
    std::snprintf(text, sizeof text, "uneven, to %.0f ms without a frame: 'jitter %.0f'",
                  1000 * seen.longest, std::ceil(100 * seen.longest) * 10);
    doubts.emplace_back(text);
  }
  return doubts;
}

std::vector<std::string> LiveMonitor::lines(double now, const osc::FrameGatherer& gatherer,
                                            const osc::Receiver& receiver) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < gatherer.sources().size(); ++i) {
    const osc::FrameSource& source = gatherer.sources()[i];
    if (!source.used() || source.frames() == 0 || now - source.seen() > 1) continue;
    const osc::CapturedFrame& frame = source.frame();
    const std::string name = frame.sender.name();
    const std::string bones =
        frame.joints > 0 ? std::to_string(frame.joints) + " joints" : bone_list(source.bones());
    const auto count =
        frame.joints > 0 ? static_cast<std::size_t>(frame.joints) : source.bones().count();
    const std::string who = name + " " + std::string(osc::form_name(frame.form)) +
                            (frame.stream ? " #" + std::to_string(frame.stream) : "");
    if (std::string& told = told_bones_[who]; told != bones)
      lines.push_back(who + ": " + (told = bones));
    char text[120];
    std::snprintf(text, sizeof text, ": %.1f a second, 95 %% of the gaps below %.1f ms, %zu bones",
                  source.rate(), source.rate() > 0 ? 1000 * source.uneven() / source.rate() : 0,
                  count);
    std::string line = who + text;
    Seen& seen = seen_[gatherer.performer_of(static_cast<int>(i))];
    for (const std::string& doubt : doubts(now, source, seen)) line += "; " + doubt;
    seen.longest = 0;
    lines.push_back(line);
  }
  for (const auto& [stream, count] : plain_)
    lines.push_back(stream + ": " + std::to_string(count) + " a second");
  plain_.clear();
  const osc::Received received = receiver.received();
  if (received.faulty > before_.faulty)
    lines.push_back(std::to_string(received.faulty - before_.faulty) + " faulty messages");
  if (const std::string_view notice = receiver.notice(); !notice.empty())
    lines.emplace_back(notice);
  const bool silent = lines.empty();
  if (silent && received.packets > before_.packets)
    lines.push_back(std::to_string(received.packets - before_.packets) +
                    " packets that move no body" + receiver.unknown_addresses());
  else if (silent && !waiting_told_)
    lines.push_back("nothing comes: is the sender's port " + std::to_string(receiver.port()) +
                    ", and its address this machine's? From another machine say --any; a firewall "
                    "may stand between");
  waiting_told_ = silent;
  before_ = received;
  return lines;
}

}  // namespace gait::tool
