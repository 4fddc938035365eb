// Packets as senders make them, and what becomes of them when somebody means harm.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "gait/osc/forms.h"
#include "gait/osc/humanoid_sender.h"
#include "gait/osc/packet_template.h"

namespace gait::testing {

using Packet = std::vector<std::byte>;

// One packet of each kind a sender makes.
inline std::vector<Packet> honest_packets() {
  std::vector<Packet> packets;
  const auto add = [&](const std::string& path, const std::string& types,
                       const std::vector<std::string>& strings, const std::vector<float>& numbers) {
    osc::PacketTemplate packet;
    packet.add(path, types, strings);
    packet.add("/VMC/Ext/OK", "i");
    packet.set(numbers);
    packets.emplace_back(packet.bytes().begin(), packet.bytes().end());
    packets.emplace_back(packet.bytes().begin() + 20, packet.bytes().end() - 24);  // no bundle
  };
  const std::vector<float> numbers{1, 0.2F, 0.3F, 0.1F, 0.2F, 0.3F, 0.9F, 0.1F, 0, 0, 0, 0, 0, 0};
  add("/VMC/Ext/Root/Pos", "sfffffffffffff", {"root"}, numbers);
  add("/VMC/Ext/Bone/Pos", "sfffffff", {"LeftUpperArm"}, numbers);
  add("/skeleton/bone", "sisffff", {"A", "quat"}, numbers);
  add("/skeleton/A/bone/5/transformation", "fffffff", {}, numbers);
  add("/skel", "iifffffffff", {}, numbers);
  add("/motive/skeleton/id/bone", "sis", {"A", "LFArm"}, numbers);
  add("/perception_joint", "ifffffff", {}, numbers);
  add("/joint", "siifffff", {"l_knee"}, numbers);
  add("/ZIGSIM/a/accel", "fff", {}, numbers);
  add("/wek/inputs", "ffffffffff", {}, numbers);
  add("/pose/left_knee", "ffff", {}, numbers);
  const std::string phone = R"({"sensordata":{"accel":{"x":0,"y":0,"z":1}}})";
  const auto bytes = std::as_bytes(std::span(phone));
  packets.emplace_back(bytes.begin(), bytes.end());
  add("/gait/frame", "ffffffffff", {}, numbers);
  add("/gait/quat", "sfffffff", {"LeftArm"}, numbers);
  add("/gait/bone", "ssfff", {"LeftArm", "Spine2"}, numbers);
  add("/gait/joint", "sfff", {"Head"}, numbers);
  std::vector<int> bones;
  for (int bone = 0; bone < humanoid_bones; ++bone) bones.push_back(bone);
  for (const osc::FormFacts& facts : osc::all_forms()) {
    if (!facts.packer) continue;
    osc::HumanoidSender sender(facts.form, bones);
    sender.pack({}, 0, 0);
    for (const auto& packet : sender.packets())
      packets.emplace_back(packet.bytes().begin(), packet.bytes().end());
  }
  return packets;
}

// Bits turned, words replaced by hard ones, pieces cut, doubled or swapped with another packet's.
inline Packet mutated(const std::vector<Packet>& from, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  Packet packet = from[below(from.size())];
  for (std::size_t times = 1 + below(6); times > 0; --times) {
    const std::size_t at = below(packet.size() + 1);
    switch (below(6)) {
      case 0:
        if (at < packet.size()) packet[at] ^= static_cast<std::byte>(1U << below(8));
        break;
      case 1: {
        constexpr std::uint32_t hard[] = {0,          0x7FFFFFFF, 0x80000000, 0xFFFFFFFF,
                                          0x7FC00000, 0x7F800000, 4,          0xFFFFFFFC};
        const std::uint32_t word = hard[below(std::size(hard))];
        for (std::size_t i = 0; i < 4; ++i)
          if (at / 4 * 4 + i < packet.size())
            packet[at / 4 * 4 + i] = static_cast<std::byte>(word >> (24 - 8 * i));
        break;
      }
      case 2:
        packet.resize(at);
        break;
      case 3: {
        const Packet& other = from[below(from.size())];
        packet.insert(packet.end(),
                      other.begin() + static_cast<std::ptrdiff_t>(below(other.size())),
                      other.end());
        break;
      }
      case 4:
        packet.insert(packet.begin() + static_cast<std::ptrdiff_t>(at), below(64),
                      static_cast<std::byte>(below(256)));
        break;
      default:
        for (std::byte& byte : packet)
          if (below(8) == 0) byte = static_cast<std::byte>(below(256));
    }
    if (packet.size() > 60000) packet.resize(60000);
  }
  return packet;
}

}  // namespace gait::testing
