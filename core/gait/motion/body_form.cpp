#include "gait/motion/body_form.h"

#include <algorithm>
#include <numeric>

#include "gait/names.h"

namespace gait {
namespace {

constexpr int most_samples = 200;  // frames that tell where a joint usually is
// Of the longest bone: below the first a position is the OFFSET, rounded; above the second the
// joint moves.
constexpr double same_place = 1e-3, truly_moves = 0.03;
constexpr double next_to_nothing = 0.05;  // positions this small beside OFFSETs are added to them

// The ancestors of the hips that hold other parts of the body, from the hips' parent up.
std::vector<int> body_above_hips(const Skeleton& skeleton, const JointRoles& roles) {
  std::vector<int> above;
  if (!roles.has_legs()) return above;
  std::size_t holding = 0;
  for (int at = skeleton.joints[roles.hips].parent; at >= 0; at = skeleton.joints[at].parent) {
    const int below = above.empty() ? roles.hips : above.back();
    above.push_back(at);
    for (int role = 1; role <= static_cast<int>(Role::right_toes); ++role) {
      const int part = roles.joint(static_cast<Role>(role));
      if (skeleton.is_in_branch(part, at) && !skeleton.is_in_branch(part, below))
        holding = above.size();
    }
  }
  above.resize(holding);
  return above;
}

struct UsualPlace {
  Eigen::Vector3d median = Eigen::Vector3d::Zero();
  double spread = 0;  // between the tenth and the ninetieth of a hundred, the axis with the most
};

UsualPlace usual_place(const Clip& clip, int joint) {
  const int count = std::min(most_samples, clip.frames());
  const auto sample = [&](int i) -> const Eigen::Vector3d& {
    return clip.translation(
        static_cast<int>(static_cast<long long>(i) * clip.frames() / count))[joint];
  };
  UsualPlace usual{sample(0), 0};
  bool moves = false;
  for (int i = 1; i < count; ++i) moves = moves || sample(i) != usual.median;
  std::vector<double> values(moves ? static_cast<std::size_t>(count) : 0);
  for (int axis = 0; moves && axis < 3; ++axis) {
    for (int i = 0; i < count; ++i) values[i] = sample(i)[axis];
    std::sort(values.begin(), values.end());
    usual.median[axis] = values[count / 2];
    usual.spread = std::max(usual.spread, values[count * 9 / 10] - values[count / 10]);
  }
  return usual;
}

// Bones from the position channels of all joints but those that carry the body (`carriers`).
void take_bones_from_positions(BodyForm& form, const std::vector<bool>& carriers) {
  Clip& clip = form.clip;
  if (clip.frames() == 0) return;
  std::vector<UsualPlace> usual(clip.skeleton.joints.size());
  double longest = 0;
  for (int joint = 0; joint < clip.skeleton.size(); ++joint)
    if (!carriers[joint]) {
      usual[joint] = usual_place(clip, joint);
      longest = std::max(longest, usual[joint].median.norm());
      longest = std::max(longest, clip.skeleton.joints[joint].offset.norm());
    }
  std::vector<int> elsewhere;
  std::vector<std::string> moving;
  double positions = 0, offsets = 0;
  for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
    if (carriers[joint]) continue;
    if (usual[joint].spread > truly_moves * longest)
      moving.push_back(clip.skeleton.joints[joint].name);
    const Eigen::Vector3d& offset = clip.skeleton.joints[joint].offset;
    if ((usual[joint].median - offset).norm() <= same_place * longest) continue;
    elsewhere.push_back(joint);
    positions += usual[joint].median.norm();
    offsets += offset.norm();
  }
  const bool added = positions < next_to_nothing * offsets;
  for (const int joint : elsewhere) {
    Eigen::Vector3d& offset = clip.skeleton.joints[joint].offset;
    form.adds_to_offset[joint] = added;
    if (!added)
      offset = usual[joint].median;
    else
      for (int frame = 0; frame < clip.frames(); ++frame) clip.translation(frame)[joint] += offset;
  }
  if (moving.empty()) return;
  constexpr std::size_t most_named = 6;
  const std::size_t others = moving.size() - std::min(moving.size(), most_named);
  moving.resize(moving.size() - others);
  form.warnings.push_back(clip.name +
                          ": joints that move against their parents: " + joined_names(moving) +
                          (others > 0 ? " and " + std::to_string(others) + " others" : "") +
                          "; their bones are as long as in the middle of the clip");
}

// Turns the chain over that leads from the hips up to `chain.back()`.
class TurnedOver {
 public:
  TurnedOver(const Clip& file, const JointRoles& roles, const std::vector<int>& above)
      : file_(file), roles_(roles), chain_{roles.hips} {
    chain_.insert(chain_.end(), above.begin(), above.end());
    place_.assign(file.skeleton.joints.size(), -1);
    for (std::size_t i = 0; i < chain_.size(); ++i) place_[chain_[i]] = static_cast<int>(i);
  }

  void make(BodyForm& form) {
    order(form);
    Clip& clip = form.clip;
    clip.name = file_.name;
    clip.frame_rate = file_.frame_rate;
    std::vector<int> in_clip(file_.skeleton.joints.size());
    for (std::size_t i = 0; i < form.joint_in_file.size(); ++i)
      in_clip[form.joint_in_file[i]] = static_cast<int>(i);
    for (const int joint : form.joint_in_file) {
      Joint made = file_.skeleton.joints[joint];
      made.parent = parent(joint) < 0 ? -1 : in_clip[parent(joint)];
      made.offset = translation(
          joint, [&](int of) { return file_.skeleton.joints[of].offset; },
          [](int) { return Eigen::Quaterniond::Identity(); });
      if (is_above(joint)) turn_joint(joint, made);
      clip.skeleton.joints.push_back(std::move(made));
    }
    clip.resize(file_.frames());
    for (int frame = 0; frame < file_.frames(); ++frame)
      for (std::size_t i = 0; i < in_clip.size(); ++i) {
        const int joint = form.joint_in_file[i];
        const auto turn = [&](int of) { return file_.pose(frame)[of]; };
        clip.translation(frame)[i] = translation(
            joint, [&](int of) { return file_.translation(frame)[of]; }, turn);
        clip.pose(frame)[i] = rotation(joint, turn);
      }
    form.re_rooted = true;
  }

 private:
  bool is_above(int joint) const { return place_[joint] > 0; }
  int below(int joint) const { return chain_[place_[joint] - 1]; }  // in the file

  int parent(int joint) const {
    if (is_above(joint)) return below(joint);
    return file_.skeleton.joints[joint == chain_[0] ? chain_.back() : joint].parent;
  }

  // Parents before children; children in the file's order.
  void order(BodyForm& form) const {
    std::vector<std::vector<int>> children(file_.skeleton.joints.size());
    std::vector<int> open;
    for (int joint = file_.skeleton.size() - 1; joint >= 0; --joint)
      (parent(joint) < 0 ? open : children[parent(joint)]).push_back(joint);
    form.joint_in_file.clear();
    while (!open.empty()) {
      const int joint = open.back();
      open.pop_back();
      form.joint_in_file.push_back(joint);
      open.insert(open.end(), children[joint].begin(), children[joint].end());
    }
  }

  // From the new parent, in its frame.
  template <typename TranslationOf, typename RotationOf>
  Eigen::Vector3d translation(int joint, const TranslationOf& of, const RotationOf& turn) const {
    if (joint == chain_[0]) {  // the hips, through all that was above them
      Eigen::Vector3d way = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i + 1 < chain_.size(); ++i)
        way = turn(chain_[i + 1]) * (of(chain_[i]) + way);
      return of(chain_.back()) + way;
    }
    if (is_above(joint)) {
      if (place_[joint] == 1) return Eigen::Vector3d::Zero();
      return -of(chain_[place_[joint] - 2]);
    }
    const int file_parent = file_.skeleton.joints[joint].parent;
    if (file_parent >= 0 && is_above(file_parent)) return of(joint) - of(below(file_parent));
    return of(joint);
  }

  template <typename RotationOf>
  Eigen::Quaterniond rotation(int joint, const RotationOf& turn) const {
    if (is_above(joint)) return turn(below(joint)).conjugate();
    if (joint != chain_[0]) return turn(joint);
    Eigen::Quaterniond whole = Eigen::Quaterniond::Identity();
    for (const int above : chain_) whole = turn(above) * whole;
    return whole.normalized();
  }

  void turn_joint(int joint, Joint& made) const {
    const Joint& under = file_.skeleton.joints[below(joint)];
    for (Eigen::Vector3d& tip : made.tips) tip -= under.offset;
    if (joint == chain_.back() && under.offset.norm() > 0) made.tips.push_back(-under.offset);
    // The lowest joint of the spine sits on the hips, as a mount of a leg does.
    const bool in_leg = roles_.of_joint[joint] >= Role::left_thigh;
    made.sits_at = place_[joint] == 1 && !in_leg ? made.name : under.name;
  }

  const Clip& file_;
  const JointRoles& roles_;
  std::vector<int> chain_;  // from the hips up
  std::vector<int> place_;  // in the chain, -1: not in it
};

}  // namespace

BodyForm body_form(Clip clip, const RoleTable& table) {
  BodyForm form;
  form.clip = std::move(clip);
  const Skeleton& skeleton = form.clip.skeleton;
  form.joint_in_file.resize(skeleton.joints.size());
  std::iota(form.joint_in_file.begin(), form.joint_in_file.end(), 0);
  form.adds_to_offset.assign(skeleton.joints.size(), false);

  const JointRoles roles = find_roles(form.clip, table);
  const std::vector<int> above = body_above_hips(skeleton, roles);
  std::vector<bool> carriers;
  for (const Joint& joint : skeleton.joints) carriers.push_back(joint.parent < 0);
  for (int at = above.empty() ? roles.hips : above.back(); at >= 0; at = skeleton.joints[at].parent)
    carriers[at] = true;
  take_bones_from_positions(form, carriers);
  if (above.empty()) return form;
  const Clip file = std::move(form.clip);
  form.clip = {};
  TurnedOver(file, roles, above).make(form);
  return form;
}

}  // namespace gait
