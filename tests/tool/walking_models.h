// Models that walk by themselves, learnt from the built-in walks once a program, as files.
#pragma once

#include <string>

namespace gait::testing {

// Styles proud and sad, and the neutral walk over speed of one subject, "neutral".
std::string walking_model();
// The same without the walks over speed, and without the styles.
std::string styled_model();
std::string speed_model();

}  // namespace gait::testing
