// When a foot touches the ground, seen live from how the body's weight moves between its feet
// (RootMotion::share_of).
//
// A foot that has touched moves backward as fast as the one that stands, so its share of the pin
// rises from nothing while the other one still carries. It touches when its share passes
// `touching`, once it has been below `swinging`.
#pragma once

namespace gait {

class FootTouch {
 public:
  static constexpr float touching = 0.04f, swinging = 0.02f;

  // Takes the foot's share at a frame; true when it touches with this frame.
  bool advance(float share) noexcept {
    if (share < swinging) swings_ = true;
    if (!swings_ || share < touching) return false;
    swings_ = false;
    return true;
  }
  void reset() noexcept { swings_ = false; }

 private:
  bool swings_ = false;
};

}  // namespace gait
