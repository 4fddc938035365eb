// The one exception of learning and reading: its text says what was expected, what was found, and
// where (file, line, joint). Playing never throws.
#pragma once

#include <stdexcept>

namespace gait {

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gait
