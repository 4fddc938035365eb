// The demonstration model `gait-demo`: learnt from the built-in corpus, so that the project walks
// without captured data. It is synthetic and says so.
#pragma once

#include <string>
#include <string_view>

#include "gait/model/model.h"

namespace gait {

inline constexpr std::string_view demo_model_name = "gait-demo";

// Learns it, in a second or two. The same model on every call and for any number of threads (0: as
// many as the machine has).
Model make_demo_model(int threads = 0);

// `gait-demo`, or the model in the file of that path. Throws Error as read_model does.
Model model_named(const std::string& name_or_path);

}  // namespace gait
