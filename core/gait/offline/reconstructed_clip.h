// A whole clip reconstructed as if it had been streamed: its input joints alone go through a
// StreamReconstructor at the clip's own rate, delays are realigned and flushed.
#pragma once

#include <memory>
#include <vector>

#include "gait/model/body_pose.h"
#include "gait/motion/clip.h"
#include "gait/play/stream_reconstructor.h"

namespace gait {

struct ReconstructedClip {
  // The model's body, frame t for frame t of the clip given; hips by the feet, from the origin
  // along +Z. Poses between two frames of the model's clock are interpolated.
  Clip clip;
  // Per frame of the clip: what was decided at the last frame of the model's clock until then.
  std::vector<Decision> decisions;
  Eigen::MatrixXf style_posteriors;        // styles by frames
  std::vector<double> frame_microseconds;  // of each push with all that follows from it
  int delay_frames = 0;
};

// `poses`: of the clip's frames, in the model's body (body_poses); only input joints are looked at.
ReconstructedClip reconstruct_clip(std::shared_ptr<const Model> model, const BodyPoses& poses,
                                   double frame_rate, const std::string& name,
                                   const PlaySettings& settings);

}  // namespace gait
