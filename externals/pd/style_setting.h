// The styles a walker was told: kept by name, so that they can be said before the model is there
// and live on when it is replaced.
//
//   style NAME            only this one
//   style A 0.7 B 0.3     the whole mix
//   weight NAME W         this one, the others stay
//   styles W0 W1 ...      in the model's order
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gait/model/model.h"
#include "pd/outlet.h"

namespace gait::pd {

class StyleSetting {
 public:
  // Takes one of the messages above and says so; false for any other selector. `model` may be null
  // (not there yet): then names are checked when it comes. Throws Error, with nothing changed, for
  // what cannot be set.
  bool take(const Arguments& arguments, const Model* model);

  // One weight per style of the model; empty when nothing was set. Throws Error naming a style that
  // the model lacks, and those it has.
  std::vector<float> weights(const Model& model) const;
  bool operator==(const StyleSetting&) const = default;
  void clear() { mix_.clear(), by_order_.clear(); }

  // The message that restores it, if anything was set.
  void dump(Outlet& info) const;

 private:
  std::vector<std::pair<std::string, double>> mix_;
  std::vector<double> by_order_;  // as `styles` said it; mix_ is empty then
};

}  // namespace gait::pd
