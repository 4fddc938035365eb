#include "gait/osc/rig_sender.h"

#include <algorithm>

#include "gait/error.h"
#include "gait/osc/captured_frame.h"

namespace gait::osc {

RigSender::RigSender(const Skeleton& skeleton) {
  if (skeleton.size() > most_joints)
    throw Error("expected a rig of at most " + std::to_string(most_joints) + " joints, found " +
                std::to_string(skeleton.size()));
  std::vector<float> offsets;
  for (int joint = 0; joint < skeleton.size(); ++joint) {
    const Joint& of = skeleton.joints[joint];
    if (of.name.size() >= MocapEvent::name_size)
      throw Error("expected joints with names below " + std::to_string(MocapEvent::name_size) +
                  " letters, found '" + of.name + "'");
    rig_.add("/gait/bone", "ssfff",
             {of.name, of.parent < 0 ? "" : skeleton.joints[of.parent].name});
    for (int i = 0; i < 3; ++i) offsets.push_back(static_cast<float>(of.offset[i]));
    packets_.add("/gait/quat", "sfffffff", {of.name});
  }
  rig_.set(offsets);
  packets_.add("/gait/end", "i");
  numbers_.resize(static_cast<std::size_t>(packets_.numbers()));
}

void RigSender::pack(std::span<const Eigen::Quaterniond> rotations,
                     std::span<const Eigen::Vector3d> translations, int frame) noexcept {
  std::size_t next = 0;
  const auto add = [&](double number) { numbers_[next++] = static_cast<float>(number); };
  for (std::size_t joint = 0; joint < rotations.size(); ++joint) {
    const Eigen::Quaterniond& q = rotations[joint];
    add(q.x()), add(q.y()), add(q.z()), add(q.w());
    for (int i = 0; i < 3; ++i) add(translations[joint][i]);
  }
  add(frame);
  packets_.set(numbers_);
}

PoseSender::PoseSender(int values) {
  packets_.add("/gait/root", "ffff");
  packets_.add("/gait/frame", std::string(static_cast<std::size_t>(values), 'f'));
  numbers_.resize(static_cast<std::size_t>(values) + 4);
}

void PoseSender::pack(std::span<const float> root, std::span<const float> pose) noexcept {
  std::copy_n(root.begin(), 4, numbers_.begin());
  std::copy_n(pose.begin(), std::min(pose.size(), numbers_.size() - 4), numbers_.begin() + 4);
  packets_.set(numbers_);
}

}  // namespace gait::osc
