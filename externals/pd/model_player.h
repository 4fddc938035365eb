// A box that plays a model through one object, its player. The worker makes the player, Pd's thread
// swaps it in between two ticks, and the worker frees the old one.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "pd/models.h"
#include "pd/worker.h"

namespace gait::pd {

template <class Playing>
class ModelPlayer : public ModelUser {
 public:
  void print(const Arguments&) {
    if (playing_)
      describe();
    else
      post("%s: waiting for %s", box().name(), model_name().c_str());
  }

 protected:
  using ModelUser::ModelUser;

  // Makes what plays a model. It may run on the worker, so it holds copies of the box's settings;
  // it may throw Error.
  using Make = std::function<std::shared_ptr<Playing>(const SharedModel& model)>;
  virtual Make make() = 0;
  // Gives `fresh` the settings as they are now, and the state of the one before (playing(),
  // null at first). Throws Error when the model cannot serve.
  virtual void take(const SharedModel& model, Playing& fresh) = 0;
  // After playing() has changed.
  virtual void taken() {}
  // Prints on the console what plays.
  virtual void describe() = 0;

  // What plays; null before the model is there.
  const std::shared_ptr<Playing>& playing() const { return playing_; }

  // Plays through `fresh` from now on.
  void play(std::shared_ptr<Playing> fresh) { replace(playing_, std::move(fresh)); }

 private:
  Prepare prepare() final {
    return [this, make = make()](const SharedModel& model) -> TakeOver {
      // Only Pd's thread dereferences `this`, and only while the box exists.
      return [this, model, fresh = make(model)] {
        take(model, *fresh);
        play(fresh);
        taken();
      };
    };
  }

  std::shared_ptr<Playing> playing_;
};

}  // namespace gait::pd
