#include "gait/osc/humanoid_sender.h"

#include <cmath>

#include "gait/error.h"
#include "gait/osc/neuron_joints.h"

namespace gait::osc {

namespace {

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
        if (const int joint = neuron_joint(bone); joint >= 0) {
          bones_.push_back(bone);
          joints_.push_back(joint);
        }
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
  // Zeros where a place is not known.
  const auto place_of = [&](int bone) {
    return pose.locally_placed(bone) ? pose.local_place(bone) : Eigen::Vector3d(0, 0, 0);
  };
  if (form_ == MocapForm::vmc) {
    add_place(Eigen::Vector3d::Zero());
    add_turn(Eigen::Quaterniond::Identity());
    for (const int bone : bones_) {
      add_place(mirrored(place_of(bone)));
      add_turn(mirrored(pose.local_turn(bone)));
    }
    add(1);
    add(time);
  } else if (form_ == MocapForm::natnet) {
    add(frame);
    for (const int bone : bones_) add(bone + 1);
    for (const int bone : bones_) {
      add(bone + 1);
      add_place(place_of(bone));
      add(bone + 1);
      add_turn(pose.local_turn(bone));
    }
    add(frame);
  } else {
    for (std::size_t i = 0; i < bones_.size(); ++i) {
      const int bone = bones_[i];
      add(joints_[i]);
      add_place(pose.placed[bone] ? pose.places[bone] : Eigen::Vector3d(0, 0, 0));
      add_turn(pose.turns[bone]);
    }
  }
  packets_.set(numbers_);
}

}  // namespace gait::osc
