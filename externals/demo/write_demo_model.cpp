// Writes the built-in model into a file, at build time, so that the first box of a patch need not
// wait until it is learnt.
#include <cstdio>
#include <exception>

#include "gait/corpus/demo_model.h"
#include "gait/model/model_file.h"
#include "gait/platform/path_text.h"
#include "gait/platform/terminal.h"

int main(int count, char** values) {
  const std::vector<std::string> arguments = gait::utf8_arguments(count, values);
  if (arguments.size() != 1) {
    std::fprintf(stderr, "usage: write_demo_model FILE\n");
    return 2;
  }
  try {
    gait::write_model(gait::make_demo_model(), gait::path_from_utf8(arguments[0]));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_demo_model: %s\n", error.what());
    return 1;
  }
}
