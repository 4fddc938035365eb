// Packs Sony mocopi's own stream: see mocopi_reader.cpp. The skeleton comes before the first frame
// and every second or so.
#include <array>
#include <chrono>
#include <cstring>
#include <string_view>

#include "gait/osc/mocopi_joints.h"
#include "gait/osc/packers.h"
#include "gait/osc/wire.h"

namespace gait::osc {

namespace {

constexpr int skeleton_every = 50;  // frames

class BoxWriter {
 public:
  explicit BoxWriter(std::vector<std::byte>& bytes) : bytes_(bytes) { bytes.clear(); }
  std::size_t begin(std::string_view name) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + 8);
    std::memcpy(bytes_.data() + at + 4, name.data(), 4);
    return at;
  }
  void end(std::size_t at) {
    put_number<std::endian::little>(bytes_, at, static_cast<std::uint32_t>(bytes_.size() - at - 8));
  }
  template <typename T>
  void add(T value) {
    bytes_.resize(bytes_.size() + sizeof value);
    put_number<std::endian::little>(bytes_, bytes_.size() - sizeof value, value);
  }
  template <typename T>
  void box(std::string_view name, T value) {
    const std::size_t at = begin(name);
    add(value);
    end(at);
  }
  void text(std::string_view name, std::string_view value) {
    const std::size_t at = begin(name);
    for (const char c : value) bytes_.push_back(static_cast<std::byte>(c));
    end(at);
  }
  void transform(const Eigen::Quaterniond& q, const Eigen::Vector3d& p) {
    const std::size_t at = begin("tran");
    for (const double x : {q.x(), q.y(), q.z(), q.w(), p.x(), p.y(), p.z()})
      add(static_cast<float>(x));
    end(at);
  }
  void heads() {
    const std::size_t head = begin("head");
    text("ftyp", "sony motion format");
    box("vrsn", std::uint8_t{1});
    end(head);
    const std::size_t from = begin("sndf");
    box("ipad", std::uint64_t{0});
    box("rcvp", std::uint16_t{12351});
    end(from);
  }

 private:
  std::vector<std::byte>& bytes_;
};

class MocopiPacker final : public FormPacker {
 public:
  MocopiPacker() {
    for (int joint = 0; joint < mocopi_joints; ++joint)
      offsets_[static_cast<std::size_t>(joint)] = mocopi_offset(joint);
    for (Datagram& datagram : datagrams_) datagram.data.reserve(2048);
  }

  void pack(const HumanoidPose& pose, double time, int frame) noexcept override {
    std::array<Eigen::Quaterniond, mocopi_joints> world;
    for (int joint = 0; joint < mocopi_joints; ++joint) {
      const auto at = static_cast<std::size_t>(joint);
      const int bone = mocopi_bone(joint), parent = mocopi_parent(joint);
      // Joints between bones follow the bone above.
      if (bone >= 0 && pose.turned[static_cast<std::size_t>(bone)])
        world[at] = pose.turns[static_cast<std::size_t>(bone)];
      else
        world[at] =
            parent < 0 ? Eigen::Quaterniond::Identity() : world[static_cast<std::size_t>(parent)];
      measure(pose, world, joint);
    }
    with_skeleton_ = frame % skeleton_every == 0;
    if (with_skeleton_) write_skeleton();
    BoxWriter writer(datagrams_[1].data);
    writer.heads();
    const std::size_t fram = writer.begin("fram");
    writer.box("fnum", static_cast<std::uint32_t>(frame));
    writer.box("time", std::uint32_t{0});
    writer.box("uttm", begin_ + time);
    const std::size_t list = writer.begin("btrs");
    for (int joint = 0; joint < mocopi_joints; ++joint) {
      const auto at = static_cast<std::size_t>(joint);
      const int parent = mocopi_parent(joint);
      const std::size_t bone = writer.begin("btdt");
      writer.box("bnid", static_cast<std::uint16_t>(joint));
      writer.transform(
          parent < 0 ? world[at] : world[static_cast<std::size_t>(parent)].conjugate() * world[at],
          offsets_[at]);
      writer.end(bone);
    }
    writer.end(list);
    writer.end(fram);
  }
  std::span<const Datagram> packets() const noexcept override {
    return std::span(datagrams_).subspan(with_skeleton_ ? 0 : 1);
  }

 private:
  // The joint's offset, such that its bone is where it is. The trunk's joints between bones share
  // the way to the next bone.
  void measure(const HumanoidPose& pose, const std::array<Eigen::Quaterniond, mocopi_joints>& world,
               int joint) noexcept {
    const auto at = static_cast<std::size_t>(joint);
    const int parent = mocopi_parent(joint);
    const auto placed_bone = [&](int of) {
      const int bone = mocopi_bone(of);
      return bone >= 0 && pose.placed[static_cast<std::size_t>(bone)] ? bone : -1;
    };
    int to = joint;
    while (to < last_of_trunk && placed_bone(to) < 0) ++to;
    if (placed_bone(to) >= 0) {
      const Eigen::Vector3d& place = pose.places[static_cast<std::size_t>(placed_bone(to))];
      offsets_[at] = parent < 0
                         ? place
                         : Eigen::Vector3d(world[static_cast<std::size_t>(parent)].conjugate() *
                                           (place - places_[static_cast<std::size_t>(parent)])) /
                               (to - joint + 1);
    }
    places_[at] = parent < 0
                      ? offsets_[at]
                      : Eigen::Vector3d(places_[static_cast<std::size_t>(parent)] +
                                        world[static_cast<std::size_t>(parent)] * offsets_[at]);
  }

  void write_skeleton() noexcept {
    BoxWriter writer(datagrams_[0].data);
    writer.heads();
    const std::size_t skdf = writer.begin("skdf"), list = writer.begin("bons");
    for (int joint = 0; joint < mocopi_joints; ++joint) {
      const int parent = mocopi_parent(joint);
      const std::size_t bone = writer.begin("bndt");
      writer.box("bnid", static_cast<std::uint16_t>(joint));
      writer.box("pbid", static_cast<std::uint16_t>(parent < 0 ? 0xFFFF : parent));
      writer.transform(Eigen::Quaterniond::Identity(), offsets_[static_cast<std::size_t>(joint)]);
      writer.end(bone);
    }
    writer.end(list);
    writer.end(skdf);
  }

  static constexpr int last_of_trunk = 10;

  std::array<Eigen::Vector3d, mocopi_joints> offsets_, places_;
  std::array<Datagram, 2> datagrams_;
  bool with_skeleton_ = true;
  double begin_ = std::chrono::duration<double>(  // seconds since 1970
                      std::chrono::system_clock::now().time_since_epoch())
                      .count();
};

}  // namespace

std::unique_ptr<FormPacker> mocopi_packer(const std::vector<int>&) {
  return std::make_unique<MocopiPacker>();
}

}  // namespace gait::osc
