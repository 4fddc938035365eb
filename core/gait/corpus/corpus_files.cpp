#include <system_error>

#include "gait/corpus/corpus.h"
#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/files/label_file.h"

namespace gait {
namespace {

Clip in_centimetres(Clip clip) {
  constexpr double scale = 100;
  for (Joint& joint : clip.skeleton.joints) {
    joint.offset *= scale;
    for (Eigen::Vector3d& tip : joint.tips) tip *= scale;
  }
  for (Eigen::Vector3d& translation : clip.translations) translation *= scale;
  return clip;
}

}  // namespace

std::vector<std::filesystem::path> write_corpus(const std::filesystem::path& folder,
                                                std::span<const CorpusWalk> walks) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    throw Error(folder.string() +
                ": a folder for the walks was expected, but cannot be made: " + failure.message());
  std::vector<std::filesystem::path> paths;
  for (const CorpusWalk& walk : walks) {
    paths.push_back(folder / corpus_file_name(walk));
    write_bvh(bvh_from_clip(in_centimetres(walk.clip)), paths.back());
    write_labels(labels_from_contacts(walk.contacts, walk.clip.frame_rate), LabelForm::audacity,
                 std::filesystem::path(paths.back()).replace_extension(".txt"));
  }
  return paths;
}

}  // namespace gait
