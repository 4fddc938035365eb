#include "gait/osc/recording.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "gait/error.h"

namespace gait::osc {

namespace {

// Usual offset from one known bone to the next, over the unknown bones in between.
Eigen::Vector3d usual_way(int bone, int above) {
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  for (; bone >= 0 && bone != above; bone = bone_parent(bone)) way += usual_offset(bone);
  return way;
}

}  // namespace

bool Recording::add(const CapturedFrame& frame) {
  if (frames() >= most_frames || frame.values > 0) return false;
  if (frames() == 0) by_names_ = frame.form == MocapForm::gait;
  if (by_names_ != (frame.form == MocapForm::gait)) return false;
  if (by_names_) {
    add_named(frame);
  } else {
    if (!pose_.take(frame)) return false;
    if (!pose_.local().turned[index_of(Bone::hips)]) return false;  // there is no root yet
    add_humanoid();
  }
  times_.push_back(frame.time);
  return true;
}

void Recording::add_humanoid() {
  const HumanoidPose& local = pose_.local();
  auto& joints = poses_.emplace_back(humanoid_bones);
  told_ |= local.turned;
  for (std::size_t bone = 0; bone < humanoid_bones; ++bone) {
    joints[bone].rotation = local.turns[bone].cast<float>();
    joints[bone].placed = local.placed[bone];
    joints[bone].place = local.places[bone].cast<float>();
    if (local.placed[bone] && !offset_known_[bone]) {
      offset_known_.set(bone);
      offsets_[bone] = local.places[bone];
    }
  }
  joints[0].placed = pose_.placed();
  joints[0].place = pose_.world().places[0].cast<float>();
  joints[0].rotation = pose_.world().turns[0].cast<float>();
}

void Recording::add_named(const CapturedFrame& frame) {
  rig_.assign(frame.named.begin(), frame.named.begin() + frame.joints);
  auto& joints = poses_.emplace_back();
  for (const NamedJoint& named : rig_) {
    Joint joint;
    joint.rotation = Eigen::Quaternionf(named.rotation[3], named.rotation[0], named.rotation[1],
                                        named.rotation[2]);
    joint.placed = named.placed;
    joint.place = {named.place[0], named.place[1], named.place[2]};
    joints.push_back(joint);
  }
}

double Recording::frame_rate() const {
  if (frames() < 2 || !(times_.back() > times_.front())) return 30;
  // The usual interval, so that a pause in the stream does not count. Averages the middle half of
  // the intervals, because arrivals jitter.
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times_.size(); ++i) intervals.push_back(times_[i] - times_[i - 1]);
  std::ranges::sort(intervals);
  const std::size_t quarter = intervals.size() / 4;
  const std::span<const double> usual(intervals.begin() + quarter, intervals.end() - quarter);
  const double rate = static_cast<double>(usual.size()) /
                      std::max(1e-6, std::accumulate(usual.begin(), usual.end(), 0.0));
  const double whole = std::round(rate);
  return whole > 0 && std::abs(rate - whole) < 0.01 * whole ? whole : rate;
}

Skeleton Recording::humanoid_skeleton(std::vector<int>& bones) const {
  Skeleton skeleton;
  std::vector<int> joint_of(humanoid_bones, -1);
  for (int bone = 0; bone < humanoid_bones; ++bone) {
    if (!told_[bone]) continue;
    int above = bone_parent(bone);
    while (above >= 0 && !told_[above]) above = bone_parent(above);
    joint_of[bone] = skeleton.size();
    skeleton.joints.push_back({std::string(bone_name(bone)),
                               above < 0 ? -1 : joint_of[above],
                               offset_known_[bone] ? offsets_[bone] : usual_way(bone, above),
                               {}});
    bones.push_back(bone);
  }
  return skeleton;
}

Clip Recording::clip(const std::string& name) const {
  if (frames() == 0) throw Error("no frame of a body came");
  Clip clip;
  clip.name = name;
  clip.frame_rate = frame_rate();
  std::vector<int> source;  // per joint of the clip: index into a frame
  if (by_names_) {
    // Parents first, independent of the order of arrival.
    std::vector<int> joint_of(rig_.size(), -1);
    for (bool more = true; more;) {
      more = false;
      for (std::size_t i = 0; i < rig_.size(); ++i) {
        const int above = rig_[i].above;
        if (joint_of[i] >= 0 || (above >= 0 && joint_of[above] < 0)) continue;
        joint_of[i] = clip.skeleton.size();
        clip.skeleton.joints.push_back({rig_[i].name.data(),
                                        above < 0 ? -1 : joint_of[above],
                                        {rig_[i].offset[0], rig_[i].offset[1], rig_[i].offset[2]},
                                        {}});
        source.push_back(static_cast<int>(i));
        more = true;
      }
    }
  } else {
    clip.skeleton = humanoid_skeleton(source);
  }
  clip.resize(frames());
  for (int frame = 0; frame < frames(); ++frame)
    for (std::size_t joint = 0; joint < source.size(); ++joint) {
      const auto& pose = poses_[static_cast<std::size_t>(frame)];
      // Joints that arrived after the first frame are at rest until then.
      if (source[joint] >= static_cast<int>(pose.size())) continue;
      const Joint& told = pose[static_cast<std::size_t>(source[joint])];
      clip.pose(frame)[joint] = told.rotation.cast<double>().normalized();
      // A humanoid's bones keep their lengths; only its hips travel.
      if (told.placed && (by_names_ || joint == 0))
        clip.translation(frame)[joint] = told.place.cast<double>();
    }
  return clip;
}

}  // namespace gait::osc
