// The network stream of Xsens MVN (MXTP): a header of 24 bytes, then segments, big-endian. Types 01
// (Euler angles), 02 (quaternions) and 05 (Unity) move a body; what else it sends is passed over.
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "gait/osc/mvn_segments.h"
#include "gait/osc/readers.h"
#include "gait/osc/wire.h"
#include "gait/osc/world_bones.h"

namespace gait::osc {

namespace {

using MvnBytes = std::span<const std::byte>;
constexpr std::size_t header_size = 24;
constexpr std::size_t most_pieces = 16;  // datagrams of one sample

struct Header {
  int type = 0;
  std::uint32_t sample = 0, time = 0;
  int piece = 0, items = 0, character = 0, props = 0, fingers = 0;
  bool last = false;
};

struct Segment {
  Eigen::Vector3d place;
  Eigen::Quaterniond turn;
};

// A sample whose datagrams are gathered, and what is known of a character.
struct Character {
  int type = 0;
  double seen = 0;  // its last datagram, seconds
  std::uint32_t sample = 0, done = 0;
  bool any_done = false;
  int pieces = -1;  // how many there are; -1: not known yet
  std::array<std::vector<Segment>, most_pieces> parts;
  std::bitset<most_pieces> came;
  int up = 0;       // 2: Z is up; 1: Y is; 0: not known yet
  double unit = 0;  // of places, metres
};

double real_at(MvnBytes bytes, std::size_t at) {
  return double{number_at<float, std::endian::big>(bytes, at)};
}

bool segment_in(MvnBytes item, int type, Segment& segment) {
  for (int i = 0; i < 3; ++i) segment.place[i] = real_at(item, 4 + 4 * static_cast<std::size_t>(i));
  if (type == 1) {
    // MotionBuilder's and Maya's usual order: about X first.
    const double degree = std::numbers::pi / 180;
    segment.turn = Eigen::AngleAxisd(real_at(item, 24) * degree, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(real_at(item, 20) * degree, Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(real_at(item, 16) * degree, Eigen::Vector3d::UnitX());
  } else {
    segment.turn = {real_at(item, 16), real_at(item, 20), real_at(item, 24), real_at(item, 28)};
  }
  const double norm = segment.turn.norm();
  if (!segment.place.allFinite() || segment.place.norm() > 1e6 || !(norm > 1e-3) ||
      !std::isfinite(norm))
    return false;
  segment.turn.normalize();
  return true;
}

// The order of type 05, as numbers of the other types.
constexpr std::array<int, mvn_segments> unity_order{0, 15, 16, 17, 18, 19, 20, 21, 22, 1, 2, 3,
                                                    4, 11, 12, 13, 14, 7,  8,  9,  10, 5, 6};

class MvnReader final : public FormReader {
 public:
  using FormReader::read;
  Reading read(MvnBytes datagram, const Arrival& arrival, EventSink& sink) override {
    if (datagram.size() < 4 || std::memcmp(datagram.data(), "MXTP", 4) != 0)
      return Reading::unknown;
    Header header;
    if (!header_in(datagram, header)) return Reading::faulty;
    if (header.type != 1 && header.type != 2 && header.type != 5) return Reading::taken;
    const std::size_t size = header.type == 1 ? 28 : 32;
    MvnBytes items = datagram.subspan(header_size);
    if (items.size() < size * static_cast<std::size_t>(header.items) ||
        header.piece >= static_cast<int>(most_pieces))
      return Reading::faulty;
    std::vector<Segment> segments(static_cast<std::size_t>(header.items));
    for (Segment& segment : segments) {
      if (!segment_in(items, header.type, segment)) return Reading::faulty;
      items = items.subspan(size);
    }
    Character& character =
        characters_.of(arrival.sender, static_cast<std::uint32_t>(header.character));
    if (!chosen(header.type, arrival.time, character)) return Reading::taken;
    if (!gather(header, std::move(segments), character)) return Reading::taken;
    std::vector<Segment> all;
    for (int piece = 0; piece < character.pieces; ++piece) {
      const auto& part = character.parts[static_cast<std::size_t>(piece)];
      all.insert(all.end(), part.begin(), part.end());
    }
    character.came.reset();
    character.done = header.sample;
    character.any_done = true;
    if (all.size() < mvn_segments) return Reading::faulty;
    tell(header, all, character, arrival, sink);
    return Reading::taken;
  }

 private:
  static bool header_in(MvnBytes bytes, Header& header) {
    if (bytes.size() < header_size) return false;
    const auto byte = [&](std::size_t at) { return std::to_integer<int>(bytes[at]); };
    for (const std::size_t at : {4u, 5u}) {
      if (byte(at) < '0' || byte(at) > '9') return false;
      header.type = 10 * header.type + byte(at) - '0';
    }
    header.sample = number_at<std::uint32_t, std::endian::big>(bytes, 6);
    header.piece = byte(10) & 0x7F;
    header.last = (byte(10) & 0x80) != 0;
    header.items = byte(11);
    header.time = number_at<std::uint32_t, std::endian::big>(bytes, 12);
    header.character = byte(16);
    header.props = byte(18);
    header.fingers = byte(19);
    return true;
  }

  // A sender may stream several types at once: one is enough, quaternions before Euler angles.
  static bool chosen(int type, double now, Character& character) {
    const auto rank = [](int of) { return of == 2 ? 3 : of == 5 ? 2 : of; };
    if (type != character.type) {
      if (rank(type) < rank(character.type) && now - character.seen < 1) return false;
      character = {};
      character.type = type;
    }
    character.seen = now;
    return true;
  }

  // Whether the sample is whole now.
  static bool gather(const Header& header, std::vector<Segment> segments, Character& character) {
    // One that another one has overtaken; a count far from the last is of a new start.
    if (character.any_done && character.done - header.sample < 8) return false;
    if (character.sample != header.sample) {
      character.came.reset();
      character.pieces = -1;
      character.sample = header.sample;
    }
    const auto piece = static_cast<std::size_t>(header.piece);
    character.parts[piece] = std::move(segments);
    character.came.set(piece);
    if (header.last) character.pieces = header.piece + 1;
    if (character.pieces < 0) return false;
    for (int i = 0; i < character.pieces; ++i)
      if (!character.came[static_cast<std::size_t>(i)]) return false;
    return true;
  }

  // The specification says centimetres, working senders of types 02 and 05 use metres: a trunk is
  // shorter than three of its units only in metres. Where the head is above the pelvis is up.
  static void judge(const Eigen::Vector3d& trunk, int type, Character& character) {
    if (character.unit == 0) character.unit = trunk.norm() > 3 ? 0.01 : 1;
    if (character.up == 0)
      character.up =
          type != 2 || (std::abs(trunk.y()) > 0.8 * trunk.norm() && trunk.y() > 0) ? 1 : 2;
  }

  static void tell(const Header& header, std::vector<Segment>& all, Character& character,
                   const Arrival& arrival, EventSink& sink) {
    if (header.type == 5) {
      from_unity(all);
    }
    judge(all[6].place - all[0].place, header.type, character);
    const auto tell_segment = [&](const Segment& segment, int bone) {
      if (bone < 0) return;
      Eigen::Vector3d place = character.unit * segment.place;
      Eigen::Quaterniond turn = segment.turn;
      if (character.up == 2) {  // X forward, Y left, Z up
        place = Eigen::Vector3d(place.y(), place.z(), place.x());
        turn = {turn.w(), turn.y(), turn.z(), turn.x()};
      }
      tell_bone(MocapForm::mvn, arrival, static_cast<std::uint32_t>(header.character), bone, turn,
                &place, sink);
    };
    for (int segment = 0; segment < mvn_segments; ++segment)
      tell_segment(all[static_cast<std::size_t>(segment)], mvn_bone(segment));
    const std::size_t hands = mvn_segments + static_cast<std::size_t>(header.props);
    if (header.fingers == 2 * mvn_hand && all.size() >= hands + 2 * mvn_hand)
      for (int segment = 0; segment < 2 * mvn_hand; ++segment)
        tell_segment(all[hands + static_cast<std::size_t>(segment)],
                     segment < mvn_hand ? mvn_finger_bone(segment, Bone::left_fingers)
                                        : mvn_finger_bone(segment - mvn_hand, Bone::right_fingers));
    tell_end(MocapForm::mvn, arrival, header.time / 1000.0, sink);
  }

  // Unity's axes, and all but the pelvis relative to the parent: into the world.
  static void from_unity(std::vector<Segment>& all) {
    std::vector<Segment> world(mvn_segments);
    for (std::size_t i = 0; i < mvn_segments; ++i)
      world[static_cast<std::size_t>(unity_order[i])] = {mirrored(all[i].place),
                                                         mirrored(all[i].turn)};
    for (int segment = 1; segment < mvn_segments; ++segment) {
      const Segment& above = world[static_cast<std::size_t>(mvn_parent(segment))];
      Segment& here = world[static_cast<std::size_t>(segment)];
      here.place = above.place + above.turn * here.place;
      here.turn = (above.turn * here.turn).normalized();
    }
    all = std::move(world);
  }

  PerSender<Character, 32> characters_;
};

}  // namespace

std::unique_ptr<FormReader> mvn_reader() { return std::make_unique<MvnReader>(); }

}  // namespace gait::osc
