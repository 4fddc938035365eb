// Built-in walks to play, for clip players without a file.
#pragma once

#include <string>
#include <string_view>

#include "gait/model/body_motion.h"
#include "gait/model/model.h"
#include "gait/motion/clip.h"

namespace gait {

// True for `gait-demo`, and for `gait-demo:STYLE`, `gait-demo:STYLE:TAKE`.
bool names_demo_motion(std::string_view name);

// That walk on the model's body, cut to eight whole cycles, from right contact to right contact, so
// that it loops as a walk. STYLE: one of corpus_styles or neutral, the first style where it is not
// said; TAKE from 1, another passage of the same walker. Another walker than those the model
// gait-demo was learnt from. Throws Error naming the styles there are, or the joints a model of
// another body lacks.
BodyMotion demo_motion(std::string_view name, const Model& model);

// A built-in walk, or the BVH file of that path. Throws Error as demo_motion or read_motion does.
BodyMotion motion_named(const std::string& name_or_path, const Model& model);

}  // namespace gait
