// The command line program `gait`: what is done before the show.
#include <cstdio>

int main() {
  std::puts("gait");
  return 0;
}
