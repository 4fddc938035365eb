// The settings of [gait.synth]. They may be made before the model is there, and hold for the models
// that follow.
//
//   style, weight, styles   see StyleSetting
//   joint ...               see JointSetting
//   auto 0|1                labels follow by themselves
//   duration scale|shift|fix X, cadence C
//   past N|all, future N    frames of the fed trajectory's queue
//   onlost walk|hold|stop
//   body out|pose
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "pd/style_setting.h"
#include "synth_joint_setting.h"

namespace gait::pd {

class SynthSetting {
 public:
  // Takes one of the messages above; false: it is another message. `synthesiser` may be
  // null (no model yet). Throws Error, with nothing changed, for what cannot be set.
  bool take(const Arguments& arguments, Synthesiser* synthesiser);
  // Gives all settings to a synthesiser. One that does not fit the model is dropped, and `failed`
  // gets the reason. `goes_on`: the synthesiser has taken over another one's walk and its styles.
  void apply(Synthesiser& synthesiser, bool goes_on,
             const std::function<void(const std::string&)>& failed);
  // The messages that restore it.
  void dump(Outlet& info) const;

  // Whether frames go out as whole bodies; nothing: those of a walk by itself do, others do not.
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
