// What a body does whose input stops.
#pragma once

namespace gait {

enum class OnLost {
  walk,  // on, alone
  hold,  // comes to rest in the pose it was in
  stop   // no more frames
};

}  // namespace gait
