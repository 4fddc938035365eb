#include "train_clip.h"

#include <filesystem>

#include "gait/model/body_motion.h"
#include "gait/platform/path_text.h"
#include "pd/pose_values.h"

namespace gait::pd {

namespace {

std::string label_of(const std::filesystem::path& file) {
  std::string name = utf8_of(file.stem());
  if (name.starts_with("walk_")) name.erase(0, 5);
  const std::size_t last = name.rfind('_');
  if (last != std::string::npos && last > 0 &&
      name.find_first_not_of("0123456789", last + 1) == std::string::npos)
    name.erase(last);
  return name;
}

}  // namespace

RecordedTake take_of_clip(const std::filesystem::path& path, const Model& model) {
  const BodyMotion motion = read_motion(path, model);
  PoseValues values(*model.body);
  RecordedTake take{label_of(path), 3 * motion.joints, 0, {}, {}};
  for (int frame = 0; frame < motion.frames(); ++frame) {
    take.seconds.push_back(frame / motion.frame_rate);
    const std::span<const float> pose = values.of(motion.pose(frame));
    take.values.insert(take.values.end(), pose.begin(), pose.end());
  }
  return take;
}

}  // namespace gait::pd
