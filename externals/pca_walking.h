// What [gait.pca] needs of either of its walkers: settings that outlive a model, and a walk.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "gait/motion/steps.h"
#include "pd/model_player.h"

namespace gait::pd {

class CycleWalking {
 public:
  virtual ~CycleWalking() = default;

  // A walker in a model, of a class that only its own kind of walking knows.
  struct Walker {
    virtual ~Walker() = default;
  };
  // Makes a walker with the settings as they are now. The function may run on any thread: it holds
  // copies of all it needs. It throws Error when the model cannot serve.
  virtual std::function<std::shared_ptr<Walker>(const SharedModel&)> prepare() const = 0;
  // Walks by that walker from now on, at the phase the old one was at; gives the old one back.
  // Throws Error, with nothing changed, when settings do not fit the model.
  virtual std::shared_ptr<Walker> take(const SharedModel& model,
                                       std::shared_ptr<Walker> walker) = 0;
  // Which space of a model that can serve scores are of.
  using SpaceOf = const CycleSpace& (*)(const Model& model);
  virtual SpaceOf space_of() const = 0;
  // A setting of this walker's own; false when it has no such message. Throws Error, with nothing
  // changed, when it cannot be set. Before there is a model, it is kept.
  virtual bool set(const Arguments& arguments) = 0;
  // Every setting as the message that restores it.
  virtual void dump(Outlet& info) const = 0;

  // Only with a model. At most longest_advance at a time, so that no contact is passed over.
  static constexpr double longest_advance = 0.1;  // seconds
  virtual void advance(double seconds) noexcept = 0;
  virtual void scrub(double phase) noexcept = 0;
  virtual void reset() noexcept = 0;
  virtual std::span<const Eigen::Quaternionf> pose() const noexcept = 0;
  virtual double phase() const noexcept = 0;
  virtual float cadence() const noexcept = 0;
  virtual std::optional<Foot> contact() const noexcept = 0;
  // Of the cycle being walked, in deviations, when the walker knows them; else empty, and they have
  // to be found by projection.
  virtual std::span<const float> scores() noexcept { return {}; }
  // Leg length of the walker, metres, when it is another than the body's; else 0.
  virtual float leg_length() const noexcept { return 0; }
};

std::unique_ptr<CycleWalking> make_style_walking();
std::unique_ptr<CycleWalking> make_speed_walking();

}  // namespace gait::pd
