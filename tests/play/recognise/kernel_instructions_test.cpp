// How many instructions a whitening takes with each kernel: what times on a busy machine do not
// show, such as vectors that a compiler keeps on the stack.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include "gait/play/recognise/packed_map.h"

namespace gait {
namespace {

#ifdef GAIT_KERNEL_DRIVER

// Of the driver, counted by Valgrind. Nothing where Valgrind's processor has no such kernel.
std::optional<long> instructions(const std::string& kernel, int times) {
  const std::string command =
      "valgrind --tool=callgrind --callgrind-out-file=/dev/null '" GAIT_KERNEL_DRIVER "' " +
      kernel + " " + std::to_string(times) + " 2>&1";
  FILE* const pipe = popen(command.c_str(), "r");
  if (!pipe) return std::nullopt;
  std::string said;
  char line[512];
  while (std::fgets(line, sizeof line, pipe)) said += line;
  const int status = pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 3) return std::nullopt;
  EXPECT_EQ(status, 0) << said;
  const std::string before = "Collected : ";
  const std::size_t at = said.find(before);
  if (at == std::string::npos) {
    ADD_FAILURE() << said;
    return std::nullopt;
  }
  return std::stol(said.substr(at + before.size()));
}

TEST(KernelInstructions, of_a_whitening_are_as_few_as_vectors_in_registers_take) {
  if (std::system("command -v valgrind >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "no valgrind to count instructions with";
  // Of each of the 720 columns of 16 numbers. GCC 12 and 14 take 4.9 (AVX2) and 15.9 (SSE2), Clang
  // 14 and 19 take 5.3 and 16.9; with vectors on the stack it was five times as many.
  const std::pair<const char*, double> most[] = {{"avx512", 4}, {"avx2", 6.2}, {"portable", 20}};
  for (const auto& [kernel, most_each] : most) {
    const auto few = instructions(kernel, 100), many = instructions(kernel, 1100);
    if (!few || !many) {
      std::printf("%s: not counted, Valgrind's processor has no such kernel\n", kernel);
      continue;
    }
    const double each = static_cast<double>(*many - *few) / 1000 / 720;
    std::printf("%s: %.1f instructions a column\n", kernel, each);
    EXPECT_GT(each, 2) << kernel;
    EXPECT_LT(each, most_each) << kernel;
  }
}

#else
TEST(KernelInstructions, of_a_whitening_are_as_few_as_vectors_in_registers_take) {
  GTEST_SKIP() << "sanitizers change them";
}
#endif

}  // namespace
}  // namespace gait
