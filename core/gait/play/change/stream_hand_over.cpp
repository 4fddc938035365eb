#include "gait/play/change/stream_hand_over.h"

#include "gait/motion/rotation.h"

namespace gait {

StreamHandOver::StreamHandOver(const StreamLayout& layout, double frame_rate)
    : hand_over_(layout.values(), frame_rate, hand_over_seconds),
      offset_(Eigen::VectorXf::Zero(layout.values())),
      offset_before_(offset_) {
  for (const StreamPlace& place : layout)
    if (place.turns())
      rotations_.push_back(place.begin);
    else
      for (int i = 0; i < place.size; ++i) plain_.push_back(place.begin + i);
}

void StreamHandOver::difference(const Values& shown, const Values& motion,
                                Eigen::VectorXf& offset) noexcept {
  const auto turned = [](const Values& values, Eigen::Index at) {
    return exponential_map<float>(Vector3<float>(values.segment<3>(at)));
  };
  for (const Eigen::Index at : rotations_)
    offset.segment<3>(at) =
        rotation_vector<float>(turned(motion, at).conjugate() * turned(shown, at));
  for (const Eigen::Index at : plain_) offset[at] = shown[at] - motion[at];
}

void StreamHandOver::add(Eigen::Ref<Eigen::VectorXf> values,
                         const Eigen::VectorXf& offset) noexcept {
  for (const Eigen::Index at : rotations_)
    values.segment<3>(at) =
        rotation_vector<float>(exponential_map<float>(Vector3<float>(values.segment<3>(at))) *
                               exponential_map<float>(Vector3<float>(offset.segment<3>(at))));
  for (const Eigen::Index at : plain_) values[at] += offset[at];
}

void StreamHandOver::begin(const Values& shown, const Values& shown_before, const Values& motion,
                           const Values& motion_before) noexcept {
  difference(shown, motion, offset_);
  difference(shown_before, motion_before, offset_before_);
  hand_over_.begin(offset_, offset_before_);
}

void StreamHandOver::begin(const Values& shown, const Values& motion) noexcept {
  difference(shown, motion, offset_);
  hand_over_.begin(offset_, offset_);
}

void StreamHandOver::begin_before(const Values& shown, const Values& shown_before,
                                  const Values& first) noexcept {
  difference(shown, shown_before, offset_);  // what was shown turned by this in its last frame
  offset_before_ = shown;
  add(offset_before_, offset_);  // where it would be now
  difference(offset_before_, first, offset_);
  hand_over_.begin(offset_, offset_);
}

void StreamHandOver::apply(Eigen::Ref<Eigen::VectorXf> values) noexcept {
  if (hand_over_.over()) return;
  const Eigen::VectorXf& offset = hand_over_.advance();
  if (!hand_over_.over()) add(values, offset);
}

}  // namespace gait
