// Packs the network stream of Xsens MVN, type 02: see mvn_reader.cpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

#include "gait/osc/mvn_segments.h"
#include "gait/osc/packers.h"
#include "gait/osc/wire.h"

namespace gait::osc {

namespace {

constexpr std::size_t mvn_header = 24, mvn_item = 32;
constexpr int name_every = 60;  // frames

class MvnPacker final : public FormPacker {
 public:
  explicit MvnPacker(const std::vector<int>& bones)
      : fingers_(std::ranges::any_of(
            bones, [](int bone) { return bone >= index_of(Bone::left_fingers); })) {
    const int items = mvn_segments + (fingers_ ? 2 * mvn_hand : 0);
    datagrams_[1].data.resize(mvn_header + mvn_item * static_cast<std::size_t>(items));
    write_header(datagrams_[1].data, "MXTP02", items);
    constexpr std::string_view name = "name:gait\n";
    datagrams_[0].data.resize(mvn_header + name.size());
    write_header(datagrams_[0].data, "MXTP12", 0);
    std::memcpy(datagrams_[0].data.data() + mvn_header, name.data(), name.size());
  }

  void pack(const HumanoidPose& pose, double time, int frame) noexcept override {
    named_ = frame % name_every == 0;
    for (Datagram& datagram : datagrams_) {
      put_number<std::endian::big>(datagram.data, 6, static_cast<std::uint32_t>(frame));
      put_number<std::endian::big>(datagram.data, 12,
                                   static_cast<std::uint32_t>(std::llround(1000 * time)));
    }
    std::array<Item, mvn_segments> body;
    for (int segment = 0; segment < mvn_segments; ++segment) {
      const int parent = mvn_parent(segment);
      Item& item = body[static_cast<std::size_t>(segment)];
      if (parent >= 0) item = body[static_cast<std::size_t>(parent)];
      take(pose, mvn_bone(segment), item);
      write(segment, item);
    }
    for (int segment = 0; fingers_ && segment < 2 * mvn_hand; ++segment) {
      const bool left = segment < mvn_hand;
      Item item = body[left ? 14 : 10];
      take(pose,
           mvn_finger_bone(segment % mvn_hand, left ? Bone::left_fingers : Bone::right_fingers),
           item);
      write(mvn_segments + segment, item);
    }
  }
  std::span<const Datagram> packets() const noexcept override {
    return std::span(datagrams_).subspan(named_ ? 0 : 1);
  }

 private:
  struct Item {
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
  };
  static void take(const HumanoidPose& pose, int bone, Item& item) noexcept {
    if (bone < 0) return;
    const auto at = static_cast<std::size_t>(bone);
    if (pose.turned[at]) item.turn = pose.turns[at];
    if (pose.placed[at]) item.place = pose.places[at];
  }

  void write_header(std::span<std::byte> bytes, std::string_view type, int items) noexcept {
    std::memcpy(bytes.data(), type.data(), 6);
    bytes[10] = std::byte{0x80};  // the only datagram of its sample
    bytes[11] = static_cast<std::byte>(items);
    bytes[17] = static_cast<std::byte>(mvn_segments);
    bytes[19] = static_cast<std::byte>(fingers_ ? 2 * mvn_hand : 0);
    put_number<std::endian::big>(bytes, 22, static_cast<std::uint16_t>(bytes.size() - mvn_header));
  }
  // X forward, Y left, Z up; rotations w x y z.
  void write(int segment, const Item& item) noexcept {
    const std::span<std::byte> bytes(datagrams_[1].data);
    std::size_t at = mvn_header + mvn_item * static_cast<std::size_t>(segment);
    put_number<std::endian::big>(bytes, at, static_cast<std::uint32_t>(segment + 1));
    const Eigen::Vector3d& p = item.place;
    const Eigen::Quaterniond& q = item.turn;
    for (const double x : {p.z(), p.x(), p.y(), q.w(), q.z(), q.x(), q.y()})
      put_number<std::endian::big>(bytes, at += 4, static_cast<float>(x));
  }

  bool fingers_, named_ = true;
  std::array<Datagram, 2> datagrams_;
};

}  // namespace

std::unique_ptr<FormPacker> mvn_packer(const std::vector<int>& bones) {
  return std::make_unique<MvnPacker>(bones);
}

}  // namespace gait::osc
