// A BVH file reconstructed: the same skeleton, rate and frames, the model's output joints
// synthesised from its input joints alone.
//
// Nothing leaks: what the file says of any joint that is not an input is not looked at, but for
// which axis points up, and that only where the whole file agrees on one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gait/files/bvh.h"
#include "gait/motion/body_frame.h"
#include "gait/offline/reconstructed_clip.h"

namespace gait {

// Where the hips of the written file come from.
enum class FileRoot {
  // Hips by the feet, from the origin along +Z; joints above them at rest, at the origin. Where the
  // trunk hangs above the hips (a root at the head) it stays as measured: the hips follow its
  // heading from where they were, and the root's place goes with them.
  feet,
  file  // place and heading of the hips as in the file, joints above them untouched
};

struct ReconstructedFile {
  BvhFile file;
  ReconstructedClip walk;             // in metres, with the decisions per frame
  std::vector<std::string> warnings;  // of the guesses of unit and up axis
};

// Values of input joints, and of joints the model does not know, stay as they are. Output joints
// rest at their offsets where they have position channels. `calibrate`: bones may rest in other
// directions than the model's (motion/rest_calibration.h). The root is moved only when the hips
// are among the outputs or the inputs. Throws Error naming the joints that the file lacks, whose
// rest directions differ from the model's, or whose channels cannot take a rotation.
ReconstructedFile reconstruct_file(std::shared_ptr<const Model> model, const BvhFile& file,
                                   const BodyFrameOverride& said, const PlaySettings& settings,
                                   FileRoot root, bool calibrate = false);

}  // namespace gait
