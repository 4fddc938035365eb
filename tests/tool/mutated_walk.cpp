#include "tool/mutated_walk.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "gait/motion/joint_roles.h"
#include "gait/motion/rotation.h"

namespace gait::testing {
namespace {

using Random = std::mt19937_64;

int below(Random& random, int limit) { return static_cast<int>(random() % limit); }
double between(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}
bool sometimes(Random& random, double share) { return between(random, 0, 1) < share; }

// A rig whose joints say where they are and how they are turned in the world, frame by frame. The
// tree is free: any joint may hang below any other whose rotation carries it.
struct Node {
  std::string name;
  int parent = -1;
  std::vector<Eigen::Vector3d> tips;
};
struct World {
  std::vector<Node> nodes;  // parents before children
  double frame_rate = 30;
  // Per frame and node.
  std::vector<std::vector<Eigen::Quaterniond>> rotations;
  std::vector<std::vector<Eigen::Vector3d>> places;
};

World world_of(const Clip& clip) {
  World world;
  world.frame_rate = clip.frame_rate;
  for (const Joint& joint : clip.skeleton.joints)
    world.nodes.push_back({joint.name, joint.parent, joint.tips});
  for (int frame = 0; frame < clip.frames(); ++frame) {
    auto& rotations = world.rotations.emplace_back();
    auto& places = world.places.emplace_back();
    for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
      const int parent = clip.skeleton.joints[joint].parent;
      const Eigen::Vector3d& translation = clip.translation(frame)[joint];
      rotations.push_back(parent < 0 ? clip.pose(frame)[joint]
                                     : rotations[parent] * clip.pose(frame)[joint]);
      places.push_back(parent < 0 ? translation : places[parent] + rotations[parent] * translation);
    }
  }
  return world;
}

// Back to a clip; a joint's offset is where it lies in its parent's frame in frame 0.
Clip clip_of(const World& world, const std::string& name) {
  Clip clip;
  clip.name = name;
  clip.frame_rate = world.frame_rate;
  const auto local = [&](std::size_t frame, std::size_t node) -> Eigen::Vector3d {
    const int parent = world.nodes[node].parent;
    const Eigen::Vector3d& place = world.places[frame][node];
    return parent < 0
               ? place
               : world.rotations[frame][parent].conjugate() * (place - world.places[frame][parent]);
  };
  for (std::size_t node = 0; node < world.nodes.size(); ++node) {
    const Node& of = world.nodes[node];
    clip.skeleton.joints.push_back(
        {of.name, of.parent, of.parent < 0 ? Eigen::Vector3d::Zero() : local(0, node), of.tips});
  }
  clip.resize(static_cast<int>(world.rotations.size()));
  for (int frame = 0; frame < clip.frames(); ++frame)
    for (int node = 0; node < clip.skeleton.size(); ++node) {
      const int parent = world.nodes[node].parent;
      const auto& rotations = world.rotations[frame];
      clip.pose(frame)[node] =
          parent < 0 ? rotations[node] : rotations[parent].conjugate() * rotations[node];
      clip.translation(frame)[node] = local(frame, node);
    }
  return clip;
}

// The same nodes in another order; `order` lists them, parents first.
World ordered(const World& world, const std::vector<int>& order) {
  World result = world;
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<int>(i);
  for (std::size_t i = 0; i < order.size(); ++i) {
    result.nodes[i] = world.nodes[order[i]];
    if (result.nodes[i].parent >= 0) result.nodes[i].parent = place[result.nodes[i].parent];
    for (std::size_t frame = 0; frame < world.places.size(); ++frame) {
      result.rotations[frame][i] = world.rotations[frame][order[i]];
      result.places[frame][i] = world.places[frame][order[i]];
    }
  }
  return result;
}

// Depth first, as a file must be, the children of each in any order.
World shuffled(const World& world, Random& random, bool shuffle) {
  std::vector<int> order, open;
  for (std::size_t i = 0; i < world.nodes.size(); ++i)
    if (world.nodes[i].parent < 0) open.push_back(static_cast<int>(i));
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    order.push_back(at);
    std::vector<int> children;
    for (std::size_t i = 0; i < world.nodes.size(); ++i)
      if (world.nodes[i].parent == at) children.insert(children.begin(), static_cast<int>(i));
    if (shuffle) std::shuffle(children.begin(), children.end(), random);
    open.insert(open.end(), children.begin(), children.end());
  }
  return ordered(world, order);
}

// Joints above the hips that never turn: the uppermost carries the body, as the lowest does in a
// game's rig, at the hips' place or below it.
void hang_below_armature(World& world, int joints, double depth) {
  for (Node& node : world.nodes) node.parent += joints;
  for (int i = joints - 1; i >= 0; --i)
    world.nodes.insert(world.nodes.begin(), {i == 0 ? "Armature" : "Root", i - 1, {}});
  for (std::size_t frame = 0; frame < world.places.size(); ++frame) {
    auto& rotations = world.rotations[frame];
    auto& places = world.places[frame];
    const Eigen::Vector3d place = places[0] - Eigen::Vector3d(0, depth, 0);
    rotations.insert(rotations.begin(), joints, Eigen::Quaterniond::Identity());
    places.insert(places.begin(), joints, place);
  }
}

// Hangs the rig up at another joint: the way from it to the hips is turned round. A joint on the
// way takes its old parent's rotation, which carries the bone between them and all that hung there.
World hung_at(const World& world, int root) {
  std::vector<int> way;  // from the new root to the old one
  for (int at = root; at >= 0; at = world.nodes[at].parent) way.push_back(at);
  World result = world;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const int at = way[i], old_parent = world.nodes[at].parent;
    result.nodes[at].parent = i == 0 ? -1 : way[i - 1];
    if (old_parent < 0) continue;
    for (std::size_t frame = 0; frame < world.places.size(); ++frame)
      result.rotations[frame][at] = world.rotations[frame][old_parent];
    result.nodes[at].tips.clear();
  }
  // What hung beside the way hangs where the rotation that carries it went: on the way's joint
  // before. The new root had no children.
  for (std::size_t node = 0; node < world.nodes.size(); ++node) {
    if (std::count(way.begin(), way.end(), static_cast<int>(node))) continue;
    const auto on_way = std::find(way.begin(), way.end(), world.nodes[node].parent);
    if (on_way != way.end() && on_way != way.begin() && on_way + 1 != way.end())
      result.nodes[node].parent = *(on_way - 1);
  }
  return result;
}

struct Naming {
  const char* told;
  std::string (*name)(Role role, const std::string& own, int number);
};

// "Left" or "Right" of a role, or nothing, and what is left of the role's name.
struct Sided {
  char side;  // 'l', 'r', or 0
  std::string part;
};
Sided sided(Role role) {
  const std::string name(role_name(role));
  if (name.starts_with("left ")) return {'l', name.substr(5)};
  if (name.starts_with("right ")) return {'r', name.substr(6)};
  return {0, name};
}

std::string by_table(Role role, const std::string& own, int number,
                     const std::map<std::string, std::string>& parts,
                     std::string (*join)(char side, const std::string& part)) {
  const auto [side, part] = sided(role);
  const auto known = parts.find(part);
  if (known == parts.end()) return own;
  return join(side, known->second + (part == "spine" && number > 0 ? std::to_string(number) : ""));
}

const std::vector<Naming>& namings() {
  static const std::vector<Naming> all{
      {"own names", [](Role, const std::string& own, int) { return own; }},
      {"mixamorig:", [](Role, const std::string& own, int) { return "mixamorig:" + own; }},
      {"upper case",
       [](Role, const std::string& own, int) {
         std::string name = own;
         for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
         return name;
       }},
      {"a namespace", [](Role, const std::string& own, int) { return "Actor_01:" + own; }},
      {"Unity's names",
       [](Role role, const std::string& own, int number) {
         return by_table(role, own, number,
                         {{"hips", "Hips"},
                          {"spine", "Spine"},
                          {"neck", "Neck"},
                          {"head", "Head"},
                          {"shoulder", "Shoulder"},
                          {"arm", "UpperArm"},
                          {"forearm", "LowerArm"},
                          {"hand", "Hand"},
                          {"thigh", "UpperLeg"},
                          {"shank", "LowerLeg"},
                          {"foot", "Foot"},
                          {"toes", "Toes"}},
                         [](char side, const std::string& part) {
                           return (side == 'l' ? "Left" : side == 'r' ? "Right" : "") + part;
                         });
       }},
      {"Blender's names",
       [](Role role, const std::string& own, int number) {
         return by_table(role, own, number,
                         {{"hips", "hips"},
                          {"spine", "spine"},
                          {"neck", "neck"},
                          {"head", "head"},
                          {"shoulder", "shoulder"},
                          {"arm", "upper_arm"},
                          {"forearm", "forearm"},
                          {"hand", "hand"},
                          {"thigh", "thigh"},
                          {"shank", "shin"},
                          {"foot", "foot"},
                          {"toes", "toe"}},
                         [](char side, const std::string& part) {
                           return part + (side == 'l' ? ".L" : side == 'r' ? ".R" : "");
                         });
       }},
      {"Biped's names",
       [](Role role, const std::string& own, int number) {
         return by_table(
             role, own, number,
             {{"hips", "Pelvis"},
              {"spine", "Spine"},
              {"neck", "Neck"},
              {"head", "Head"},
              {"shoulder", "Clavicle"},
              {"arm", "UpperArm"},
              {"forearm", "Forearm"},
              {"hand", "Hand"},
              {"thigh", "Thigh"},
              {"shank", "Calf"},
              {"foot", "Foot"},
              {"toes", "Toe0"}},
             [](char side, const std::string& part) {
               return std::string("Bip01 ") + (side == 'l' ? "L " : side == 'r' ? "R " : "") + part;
             });
       }},
      {"names that end in _JNT", [](Role, const std::string& own, int) { return own + "_JNT"; }},
      {"Poser's names", [](Role role, const std::string& own, int number) {
         return by_table(role, own, number,
                         {{"hips", "hip"},
                          {"spine", "abdomen"},
                          {"neck", "neck"},
                          {"head", "head"},
                          {"shoulder", "Collar"},
                          {"arm", "Shldr"},
                          {"forearm", "ForeArm"},
                          {"hand", "Hand"},
                          {"thigh", "Thigh"},
                          {"shank", "Shin"},
                          {"foot", "Foot"},
                          {"toes", "Toe"}},
                         [](char side, const std::string& part) {
                           return (side ? std::string(1, side) : "") + part;
                         });
       }}};
  return all;
}

struct AxesAndUnit {
  const char* told;
  double metres;
};
constexpr AxesAndUnit units[]{{"m", 1},       {"cm", 0.01},   {"mm", 0.001},
                              {"in", 0.0254}, {"ft", 0.3048}, {"dm", 0.1}};

void add(std::string& told, const std::string& what) { told += (told.empty() ? "" : ", ") + what; }

// Bones as an adult's or a child's, time with them, for legs that are short swing fast.
void resize_body(World& world, Random& random, Mutation& mutation) {
  const bool child = sometimes(random, 0.3);
  mutation.leg_factor = child ? between(random, 0.5, 0.8) : between(random, 0.92, 1.12);
  mutation.frame_factor = 1 / std::sqrt(mutation.leg_factor);
  world.frame_rate *= mutation.frame_factor;
  for (auto& places : world.places)
    for (Eigen::Vector3d& place : places) place *= mutation.leg_factor;
  for (Node& node : world.nodes)
    for (Eigen::Vector3d& tip : node.tips) tip *= mutation.leg_factor;
  add(mutation.told, "legs times " + std::to_string(mutation.leg_factor));
}

void turn_world(World& world, const Eigen::Quaterniond& turn, const Eigen::Vector3d& move,
                double scale) {
  for (std::size_t frame = 0; frame < world.places.size(); ++frame)
    for (std::size_t node = 0; node < world.nodes.size(); ++node) {
      world.places[frame][node] = scale * (turn * (world.places[frame][node] + move));
      world.rotations[frame][node] = turn * world.rotations[frame][node];
    }
  for (Node& node : world.nodes)
    for (Eigen::Vector3d& tip : node.tips) tip *= scale;
}

void write_values(BvhFile& file, const Clip& clip, int rest_rows, bool rest_at_origin) {
  Eigen::Index columns = 0;
  for (const auto& channels : file.channels) columns += static_cast<Eigen::Index>(channels.size());
  file.values.setZero(rest_rows + clip.frames(), columns);
  for (int row = 0; row < file.values.rows(); ++row)
    for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
      const int frame = row - rest_rows;
      if (frame >= 0) set_rotation(file, row, joint, clip.pose(frame)[joint]);
      if (frame >= 0 || clip.skeleton.joints[joint].parent >= 0 || !rest_at_origin)
        set_translation(file, row, joint, clip.translation(std::max(0, frame))[joint]);
    }
}

}  // namespace

Mutation mutated(const Clip& walk, std::uint64_t seed) {
  Random random(seed);
  Mutation mutation;
  World world = world_of(walk);
  const JointRoles roles = find_roles(walk.skeleton);

  const Naming& naming = namings()[below(random, static_cast<int>(namings().size()))];
  std::map<Role, int> numbers;
  for (std::size_t node = 0; node < world.nodes.size(); ++node) {
    const Role role = roles.of_joint[node];
    const int number = numbers[role]++;
    world.nodes[node].name = naming.name(role, world.nodes[node].name, number);
    if (number == 0) mutation.names[role] = world.nodes[node].name;
  }
  add(mutation.told, naming.told);

  const int root = below(random, 4);
  if (root == 0) {
    world = hung_at(world, roles.joint(Role::head));
    add(mutation.told, "hung at the head");
  } else if (root == 1) {
    const int joints = 1 + below(random, 2);
    hang_below_armature(world, joints, sometimes(random, 0.5) ? 0 : 0.8);
    add(mutation.told, "below " + std::to_string(joints) + " joints");
  }
  const bool shuffle = sometimes(random, 0.5);
  world = shuffled(world, random, shuffle);
  if (shuffle) add(mutation.told, "in another order");
  if (sometimes(random, 0.6)) resize_body(world, random, mutation);

  const AxesAndUnit& unit = units[below(random, std::size(units))];
  const double about = between(random, -3, 3);
  Eigen::Quaterniond axes = about_vertical(about);
  const int up = below(random, 3);
  if (up != 1)
    axes = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitY(), Eigen::Vector3d::Unit(up)) *
           axes;
  turn_world(world, axes, {between(random, -3, 3), 0, between(random, -3, 3)}, 1 / unit.metres);
  add(mutation.told,
      std::string(unit.told) + ", up " + "xyz"[up] + ", turned by " + std::to_string(about));

  mutation.axes = axes;
  mutation.metres_per_unit = unit.metres;
  Clip clip = clip_of(world, "mutated");
  const bool in_channels = sometimes(random, 0.25);
  if (in_channels) {
    for (Joint& joint : clip.skeleton.joints) joint.offset.setZero();
    add(mutation.told, "bones in channels");
  }
  mutation.file.name = clip.name;
  mutation.file.skeleton = clip.skeleton;
  mutation.file.frame_time = 1 / clip.frame_rate;
  std::vector<Channel> order{Channel::x_rotation, Channel::y_rotation, Channel::z_rotation};
  std::shuffle(order.begin(), order.end(), random);
  const bool positions_first = sometimes(random, 0.7);
  for (const Joint& joint : clip.skeleton.joints) {
    std::vector<Channel> channels = order;
    if (joint.parent < 0 || in_channels)
      channels.insert(positions_first ? channels.begin() : channels.end(),
                      {Channel::x_position, Channel::y_position, Channel::z_position});
    mutation.file.channels.push_back(std::move(channels));
  }
  if (sometimes(random, 0.3))
    mutation.first_row = sometimes(random, 0.5) ? 1 : 1 + below(random, 40);
  const bool at_origin = sometimes(random, 0.5);
  write_values(mutation.file, clip, mutation.first_row, at_origin);
  if (mutation.first_row > 0)
    add(mutation.told, std::to_string(mutation.first_row) + " rows of rest pose" +
                           (at_origin ? " at the origin" : ""));
  return mutation;
}

}  // namespace gait::testing
