// Eigen aligns what it stores by the instruction set that it is compiled for. Structs and memory of
// a program for a larger set than the library's are laid out differently: such a program would
// crash.
#pragma once

#include <Eigen/Core>

// Defined for programs that use the installed library: what the library was compiled with.
#ifdef GAIT_EIGEN_ALIGNMENT
static_assert(EIGEN_MAX_ALIGN_BYTES == GAIT_EIGEN_ALIGNMENT,
              "gait: expected the instruction set that the library was built for; leave out "
              "-march=native, -mavx and the like, or build the library with them (GAIT_NATIVE)");
#endif
