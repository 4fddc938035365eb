// The settings of [gait.skeleton]. They may be made before the model is there, and hold for the
// models that follow.
//
//   root feet|keep|still
//   lock 0|1                feet of whole poses stay where they stand, if the root is from them
//   heading W               rad/s: the path turns
//   place x y z             where it begins
//   smooth HZ               1-euro filter, 0: off
//   leg H                   thigh and shank in metres, 0: the model's
//   delay N                 frames by which `out` is late
//   walking 0|1
//   report J ...            joints whose place and speed go out at the info outlet
#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "gait/play/body/body_stage.h"
#include "pd/outlet.h"

namespace gait::pd {

class SkeletonSetting {
 public:
  // Takes one of the messages above; false: it is another message. `stage` may be null
  // (no model yet). Throws Error, with nothing changed, for what cannot be set.
  bool take(const Arguments& arguments, BodyStage* stage);
  // Gives all settings to a stage. `report` is dropped when the model lacks one of its joints, and
  // `failed` gets the reason.
  void apply(BodyStage& stage, const std::function<void(const std::string&)>& failed);
  // The messages that restore it.
  void dump(Outlet& info) const;

  // Joints, each with the word that `report` named it by.
  const std::vector<std::pair<int, std::string>>& reported() const { return reported_; }

 private:
  using Reported = std::vector<std::pair<int, std::string>>;
  bool take_number(const Arguments& arguments);
  void take_report(const Arguments& arguments, const BodyStage* stage);
  static Reported found(const Arguments& arguments, const BodyStage& stage);
  void set(BodyStage& stage) const;

  RootFrom root_ = RootFrom::feet;
  bool lock_ = true;
  float heading_ = 0, smooth_ = 0, leg_ = 0;
  std::array<float, 3> place_{};
  int delay_ = 0;
  bool walking_ = true;
  std::vector<t_atom> report_;
  Reported reported_;
};

}  // namespace gait::pd
