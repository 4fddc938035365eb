// Settings of [gait.synth] for single joints. They may be made before the model is there, and hold
// for the models that follow.
//
//   joint J scale X        about its mean
//   joint J shift x y z
//   joint J fix x y z
//   joint J free           from all three
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "gait/play/synthesise/synthesiser.h"
#include "pd/outlet.h"

namespace gait::pd {

class JointSetting {
 public:
  // Takes a `joint` message. `synthesiser` may be null (no model yet): then it is checked when the
  // model comes. Throws Error, with nothing changed, for what cannot be set.
  void take(const Arguments& arguments, Synthesiser* synthesiser);
  // Gives all settings to a synthesiser. One that does not fit the model is dropped, and `failed`
  // gets the reason.
  void apply(Synthesiser& synthesiser, const std::function<void(const std::string&)>& failed);
  // The messages that restore it.
  void dump(Outlet& info) const;

 private:
  using Message = std::vector<t_atom>;  // a whole one, after `joint`
  static void set(const Arguments& arguments, Synthesiser& synthesiser);

  const char* object_ = "gait.synth";
  std::map<std::pair<std::string, std::string>, Message> said_;  // by joint and what
};

}  // namespace gait::pd
