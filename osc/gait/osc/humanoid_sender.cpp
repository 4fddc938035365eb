#include "gait/osc/humanoid_sender.h"

#include <cmath>

#include "gait/error.h"

namespace gait::osc {

namespace {

// NeuronOSC's number of a bone, -1: none. (neuron_reader.cpp has them the other way.)
int neuron_joint(int bone) {
  switch (static_cast<Bone>(bone)) {
    case Bone::hips:
      return 0;
    case Bone::right_upper_leg:
      return 1;
    case Bone::right_lower_leg:
      return 2;
    case Bone::right_foot:
      return 3;
    case Bone::left_upper_leg:
      return 4;
    case Bone::left_lower_leg:
      return 5;
    case Bone::left_foot:
      return 6;
    case Bone::spine:
      return 7;
    case Bone::chest:
      return 8;
    case Bone::upper_chest:
      return 10;
    case Bone::neck:
      return 11;
    case Bone::head:
      return 12;
    case Bone::right_shoulder:
      return 13;
    case Bone::right_upper_arm:
      return 14;
    case Bone::right_lower_arm:
      return 15;
    case Bone::right_hand:
      return 16;
    case Bone::left_shoulder:
      return 36;
    case Bone::left_upper_arm:
      return 37;
    case Bone::left_lower_arm:
      return 38;
    case Bone::left_hand:
      return 39;
    default:
      return -1;
  }
}

// Motive's names of the bones, for the bridge's answer to `refetch`.
std::string motive_name(int bone) {
  const std::string name(bone_name(bone));
  if (bone == index_of(Bone::spine)) return "Ab";
  return name;
}

}  // namespace

HumanoidSender::HumanoidSender(MocapForm form, const std::vector<int>& bones) : form_(form) {
  switch (form) {
    case MocapForm::vmc:
      bones_ = bones;
      packets_.add("/VMC/Ext/Root/Pos", "sfffffff", {"root"});
      for (const int bone : bones_)
        packets_.add("/VMC/Ext/Bone/Pos", "sfffffff", {std::string(bone_name(bone))});
      packets_.add("/VMC/Ext/OK", "i");
      packets_.add("/VMC/Ext/T", "f");
      break;
    case MocapForm::natnet:
      bones_ = bones;
      packets_.add("/frame/start", "i");
      for (const int bone : bones_)
        packets_.add("/motive/skeleton/id/bone", "sis", {"gait", motive_name(bone)});
      for (std::size_t i = 0; i < bones_.size(); ++i) {
        packets_.add("/skeleton/bone", "sisfff", {"gait", "position"});
        packets_.add("/skeleton/bone", "sisffff", {"gait", "quat"});
      }
      packets_.add("/frame/end", "i");
      break;
    case MocapForm::neuron:
      for (const int bone : bones)
        if (neuron_joint(bone) >= 0) bones_.push_back(bone);
      for (std::size_t i = 0; i < bones_.size(); ++i) packets_.add("/perception_joint", "ifffffff");
      break;
    default:
      throw Error("expected one of vmc, natnet, neuron to send a humanoid in");
  }
  numbers_.resize(static_cast<std::size_t>(packets_.numbers()));
}

void HumanoidSender::pack(const HumanoidPose& pose, double time, int frame) noexcept {
  std::size_t next = 0;
  const auto add = [&](double number) { numbers_[next++] = static_cast<float>(number); };
  const auto add_place = [&](const Eigen::Vector3d& p) { add(p.x()), add(p.y()), add(p.z()); };
  const auto add_turn = [&](const Eigen::Quaterniond& q) {
    add(q.x()), add(q.y()), add(q.z()), add(q.w());
  };
  // Relative to the nearest told bone above; zeros where a place is not known.
  const auto local = [&](int bone, Eigen::Vector3d& place, Eigen::Quaterniond& turn) {
    const int above = pose.turned_above(bone);
    const Eigen::Quaterniond back =
        above < 0 ? Eigen::Quaterniond::Identity() : pose.turns[above].conjugate();
    turn = back * pose.turns[bone];
    const bool known = pose.placed[bone] && (above < 0 || pose.placed[above]);
    place = known ? back * (pose.places[bone] -
                            (above < 0 ? Eigen::Vector3d(0, 0, 0) : pose.places[above]))
                  : Eigen::Vector3d(0, 0, 0);
  };
  Eigen::Vector3d place;
  Eigen::Quaterniond turn;
  if (form_ == MocapForm::vmc) {
    add_place(Eigen::Vector3d::Zero());
    add_turn(Eigen::Quaterniond::Identity());
    for (const int bone : bones_) {
      local(bone, place, turn);
      add_place(mirrored(place));
      add_turn(mirrored(turn));
    }
    add(1);
    add(time);
  } else if (form_ == MocapForm::natnet) {
    add(frame);
    for (const int bone : bones_) add(bone + 1);
    for (const int bone : bones_) {
      local(bone, place, turn);
      add(bone + 1);
      add_place(place);
      add(bone + 1);
      add_turn(turn);
    }
    add(frame);
  } else {
    for (const int bone : bones_) {
      add(neuron_joint(bone));
      add_place(pose.placed[bone] ? pose.places[bone] : Eigen::Vector3d(0, 0, 0));
      add_turn(pose.turns[bone]);
    }
  }
  packets_.set(numbers_);
}

}  // namespace gait::osc
