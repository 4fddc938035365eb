// Models by name, shared by all boxes. A name is global, as a [send]'s is; a model behind it may be
// replaced while everybody plays, between two ticks, for all its users at once.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "gait/model/model.h"
#include "gait/play/cycle_pose.h"
#include "gait/play/speed_tables.h"
#include "gait/play/state_tables.h"
#include "gait/play/step_tables.h"
#include "pd/outlet.h"
#include "pd/perf.h"
#include "pd/report.h"

namespace gait::pd {

// A model with the tables that playing needs, made once and shared. Those of walkers that the model
// cannot serve are null.
struct PlayModel {
  std::shared_ptr<const Model> model;
  std::shared_ptr<const StateTables> states;
  std::shared_ptr<const StepTables> steps;
  std::shared_ptr<const CycleTables> cycles;
  std::shared_ptr<const SpeedTables> speeds;
};

using SharedModel = std::shared_ptr<const PlayModel>;

// Throws Error when the model cannot be played. Takes some milliseconds.
SharedModel make_play_model(Model model);
// The model in a file; for the built-in name without a file, the one that lies beside the library,
// or else one learnt on the spot.
SharedModel load_model(const std::string& path);
SharedModel load_demo_model();

// A box that plays a model. Its class derives from this and calls join() at the end of its
// constructor.
class ModelUser {
 public:
  // `name`: empty for the built-in model.
  ModelUser(Box& box, std::string name);
  virtual ~ModelUser();
  ModelUser(const ModelUser&) = delete;
  ModelUser& operator=(const ModelUser&) = delete;

  const std::string& model_name() const { return name_; }

 protected:
  // Takes the model over at once when it is there already; the built-in one is loaded when nobody
  // has done so.
  void join();
  // The model, null before it is there.
  const SharedModel& model() const { return model_; }
  // Before a frame: true with a model. Else the frame is dropped and counted, and the console is
  // told once what is waited for.
  bool ready_for_frame();

  // Plays this model from now on; nothing comes between two calls but whole ticks. Throws Error
  // when it cannot serve: then it is said, and the one before stays. `old`: null for the first.
  virtual void take(const SharedModel& model, const SharedModel& old) = 0;
  // After every user of the name has taken it: `ready NAME` at the info outlet.
  virtual void say_ready() = 0;

  Box& box() { return box_; }
  Perf& perf() { return perf_; }
  SlowError& slow_error() { return slow_error_; }

 private:
  friend class Models;
  void change(const SharedModel& model);

  Box& box_;
  std::string name_;
  SharedModel model_;
  bool joined_ = false, said_waiting_ = false;
  Perf perf_;
  SlowError slow_error_;
};

class Models {
 public:
  static Models& get();

  SharedModel find(const std::string& name) const;
  // Swaps for all users of the name, then tells them. The old one is freed on the worker.
  void publish(const std::string& name, SharedModel model);

  // Runs `make` on the worker (or here, `blocking`) and publishes what it gives. `failed` gets the
  // reason on Pd's thread when it threw; nothing has changed then. A later load of the same name
  // makes an earlier one that is still running count for nothing.
  void load(const std::string& name, std::function<SharedModel()> make, bool blocking,
            std::function<void(const std::string& reason)> failed);

 private:
  friend class ModelUser;
  Models();
  void add(ModelUser* user);
  void remove(ModelUser* user);
  struct Inside;
  Inside* inside_;
};

}  // namespace gait::pd
