// Models for tests: one learnt from walking-like streams, and one as large as models get.
#pragma once

#include "gait/model/model.h"

namespace gait::testing {

// Learnt from takes of two labels in turn and two styles: two rotation streams and one plain as
// input, one rotation and one plain as output, one value that never moves, and a body of four
// joints. Small enough to be bent byte by byte.
Model learnt_model();

// Two labels of twelve states over 225 dimensions, 144 of them input, and fifteen styles: what
// real walks with the default options give.
Model large_model();

}  // namespace gait::testing
