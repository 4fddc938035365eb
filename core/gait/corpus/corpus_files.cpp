#include <system_error>

#include "gait/corpus/corpus.h"
#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/files/label_file.h"
#include "gait/platform/path_text.h"

namespace gait {
namespace {

Clip in_units(Clip clip, double metres_per_unit) {
  const double scale = 1 / metres_per_unit;
  for (Joint& joint : clip.skeleton.joints) {
    joint.offset *= scale;
    for (Eigen::Vector3d& tip : joint.tips) tip *= scale;
  }
  for (Eigen::Vector3d& translation : clip.translations) translation *= scale;
  return clip;
}

}  // namespace

std::vector<std::filesystem::path> write_corpus(const std::filesystem::path& folder,
                                                std::span<const CorpusWalk> walks,
                                                double metres_per_unit,
                                                const std::function<void(double)>& progress) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    throw Error(utf8_of(folder) + ": expected a folder to write to: " + failure.message());
  std::vector<std::filesystem::path> paths;
  for (const CorpusWalk& walk : walks) {
    paths.push_back(folder / path_from_utf8(walk.clip.name + ".bvh"));
    write_bvh(bvh_from_clip(in_units(walk.clip, metres_per_unit)), paths.back());
    write_labels(labels_from_contacts(walk.contacts, walk.clip.frame_rate), LabelForm::audacity,
                 std::filesystem::path(paths.back()).replace_extension(".txt"));
    if (progress) progress(static_cast<double>(paths.size()) / static_cast<double>(walks.size()));
  }
  return paths;
}

}  // namespace gait
