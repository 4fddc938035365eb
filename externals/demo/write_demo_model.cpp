// Writes the built-in model into a file, at build time, so that the first box of a patch need not
// wait until it is learnt.
#include <cstdio>
#include <exception>

#include "gait/corpus/demo_model.h"
#include "gait/model/model_file.h"

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: write_demo_model FILE\n");
    return 2;
  }
  try {
    gait::write_model(gait::make_demo_model(), arguments[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_demo_model: %s\n", error.what());
    return 1;
  }
}
