// The styles that a walker is to walk in, of [gait.synth] and [gait.pca]. They are kept by name:
// they may be set before the model is there, and hold for the models that follow.
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
  // Takes one of the messages above; false: it is another message. `model`: null before it is
  // there; names are then checked when it comes. Throws Error, with nothing changed, when the
  // message does not fit.
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
