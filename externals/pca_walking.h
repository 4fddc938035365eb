// A kind of walking of [gait.pca]: a walker in one model at a time, and settings that hold for all
// models.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "gait/motion/steps.h"
#include "pd/models.h"
#include "pd/worker.h"

namespace gait::pd {

class CycleWalking {
 public:
  virtual ~CycleWalking() = default;

  // Makes a walker with the settings as they are now. It may run on the worker: it holds copies of
  // all it needs. It throws Error when the model cannot serve. What it returns is for Pd's thread,
  // while this is there: it walks by the new walker from then on, at the phase of the one before.
  // It throws Error, with nothing changed, when settings do not fit the model.
  using TakeOver = std::function<void()>;
  using Prepare = std::function<TakeOver(const SharedModel& model)>;
  virtual Prepare prepare() = 0;
  // The space that scores are of, of a model that can serve.
  using SpaceOf = const CycleSpace& (*)(const Model& model);
  virtual SpaceOf space_of() const = 0;
  // A setting of this walker's own; false when it has no such message. Throws Error, with nothing
  // changed, when it cannot be set. Before there is a model, it is kept.
  virtual bool set(const Arguments& arguments) = 0;
  // Every setting as the message that restores it.
  virtual void dump(Outlet& info) const = 0;

  // These need a model. At most longest_advance at a time, so that no contact is passed over.
  static constexpr double longest_advance = 0.1;  // seconds
  virtual void advance(double seconds) noexcept = 0;
  virtual void scrub(double phase) noexcept = 0;
  virtual void reset() noexcept = 0;
  virtual std::span<const Eigen::Quaternionf> pose() const noexcept = 0;
  virtual double phase() const noexcept = 0;
  virtual float cadence() const noexcept = 0;
  virtual std::optional<Foot> contact() const noexcept = 0;
  // Scores of the cycle being walked, in deviations; empty when the walker does not know them: then
  // they are found by projection.
  virtual std::span<const float> scores() noexcept { return {}; }
  // Leg length of the walker in metres; 0: the body's.
  virtual float leg_length() const noexcept { return 0; }
};

// Walking by a `Playing::walker`.
template <class Playing>
class WalkingBy : public CycleWalking {
 public:
  Prepare prepare() final {
    return [this, make = make()](const SharedModel& model) -> TakeOver {
      return [this, model, fresh = make(model)] {
        fit(*fresh, *model->model);
        if (playing_) fresh->walker.scrub(playing_->walker.phase());
        model_ = model;
        replace(playing_, fresh);
      };
    };
  }
  void advance(double seconds) noexcept final { playing_->walker.advance(seconds); }
  void scrub(double phase) noexcept final { playing_->walker.scrub(phase); }
  std::span<const Eigen::Quaternionf> pose() const noexcept final {
    return playing_->walker.pose();
  }
  double phase() const noexcept final { return playing_->walker.phase(); }
  float cadence() const noexcept final { return playing_->walker.cadence(); }
  std::optional<Foot> contact() const noexcept final { return playing_->walker.contact(); }

 protected:
  using Make = std::function<std::shared_ptr<Playing>(const SharedModel& model)>;
  virtual Make make() const = 0;
  // Gives `fresh` the settings as they are now. Throws Error when they do not fit the model.
  virtual void fit(Playing& fresh, const Model& model) const = 0;

  // Both null before the model is there.
  SharedModel model_;
  std::shared_ptr<Playing> playing_;
};

std::unique_ptr<CycleWalking> make_style_walking();
std::unique_ptr<CycleWalking> make_speed_walking();

}  // namespace gait::pd
