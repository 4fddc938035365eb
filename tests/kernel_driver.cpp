// kernel_driver KERNEL TIMES: whitens an observation of 144 dimensions so many times with one
// kernel, for a test that counts its instructions. Exit status 3: this processor has no such
// kernel.
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "gait/play/recognise/packed_map.h"

int main(int argument_count, char** arguments) {
  if (argument_count != 3) return 2;
  const gait::PanelKernel* chosen = nullptr;
  for (const gait::PanelKernel& kernel : gait::panel_kernels())
    if (kernel.name == std::string_view(arguments[1])) chosen = &kernel;
  if (chosen == nullptr) return 3;
  gait::use_panel_kernel(*chosen);
  constexpr int size = 144;
  const gait::PackedMap map(Eigen::MatrixXd::Identity(size, size), Eigen::VectorXd::Ones(size),
                            gait::PackedMap::Shape::lower);
  const Eigen::VectorXf x = Eigen::VectorXf::Ones(size);
  Eigen::VectorXf result(size);
  float sum = 0;
  for (int i = std::atoi(arguments[2]); i > 0; --i) sum += map.apply(x.data(), size, result.data());
  std::printf("%g\n", sum);
}
