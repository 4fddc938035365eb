// What [gait.synth] was told about single joints, kept so that it can be said before the model is
// there and lives on when it is replaced.
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
  // Sets everything that was said; what the model cannot do is told to `failed` and forgotten.
  void apply(Synthesiser& synthesiser, const std::function<void(const char*)>& failed);
  // The messages that restore it.
  void dump(Outlet& info) const;

 private:
  using Message = std::vector<t_atom>;  // a whole one, after `joint`
  static void set(const Arguments& arguments, Synthesiser& synthesiser);

  const char* object_ = "gait.synth";
  std::map<std::pair<std::string, std::string>, Message> said_;  // by joint and what
};

}  // namespace gait::pd
