#include "gait/platform/terminal.h"

#include <unistd.h>

namespace gait {

std::vector<std::string> utf8_arguments(int argc, char** argv) {
  return {argv + (argc > 0 ? 1 : 0), argv + argc};
}

bool rewrites_lines(std::FILE* stream) { return isatty(fileno(stream)) != 0; }

}  // namespace gait
