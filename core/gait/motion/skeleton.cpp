#include "gait/motion/skeleton.h"

namespace gait {

int Skeleton::find(std::string_view name) const {
  for (int joint = 0; joint < size(); ++joint)
    if (joints[joint].name == name) return joint;
  return -1;
}

}  // namespace gait
