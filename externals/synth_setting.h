// What [gait.synth] was told, kept so that it can be said before the model is there and lives on
// when it is replaced.
//
//   style, weight, styles   see StyleSetting
//   joint ...               see JointSetting
//   auto 0|1                labels follow by themselves
//   duration scale|shift|fix X, cadence C
//   past N, future N        frames of the fed trajectory's queue
//   onlost walk|hold|stop
//   body out|pose
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "synth_joint_setting.h"
#include "pd/style_setting.h"

namespace gait::pd {

class SynthSetting {
 public:
  // Takes one of the messages above and says so; false for any other selector. `synthesiser` may be
  // null (no model yet). Throws Error, with nothing changed, for what cannot be set.
  bool take(const Arguments& arguments, Synthesiser* synthesiser);
  // Sets everything that was said; what the model cannot do is told to `failed` and forgotten.
  // `goes_on`: it walks where another one did, in the styles it had.
  void apply(Synthesiser& synthesiser, bool goes_on,
             const std::function<void(const char*)>& failed);
  // The messages that restore it.
  void dump(Outlet& info) const;

  // Whether frames go out as whole bodies; nothing when it depends on where they come from.
  std::optional<bool> whole_body() const { return whole_body_; }

 private:
  bool take_number(const Arguments& arguments);
  bool take_word(const Arguments& arguments);
  bool take_styles(const Arguments& arguments, Synthesiser* synthesiser);
  void set_numbers(Synthesiser& synthesiser) const;

  StyleSetting styles_;
  JointSetting joints_;
  bool auto_ = true;
  float scale_ = 1, shift_ = 0, fixed_ = 0, cadence_ = 0;
  std::optional<int> past_, future_;
  OnLost on_lost_ = OnLost::walk;
  std::optional<bool> whole_body_;
};

}  // namespace gait::pd
