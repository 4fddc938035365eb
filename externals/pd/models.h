// Models by name, shared by all boxes. A name is global, as a [send]'s is. Another model may take a
// name while boxes play: all boxes of that name change to it at once, between two ticks.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "gait/play/play_model.h"
#include "pd/outlet.h"
#include "pd/perf.h"
#include "pd/report.h"

namespace gait::pd {

using SharedModel = std::shared_ptr<const PlayModel>;

// The model in a file; for the built-in name without a file, the one that lies beside the library,
// or else one learnt on the spot.
SharedModel load_model(const std::filesystem::path& path);
SharedModel load_demo_model();

// A box that uses the model of a name. Its class derives from this and calls join() at the end of
// its constructor.
class ModelUser {
 public:
  // `name`: empty for the built-in model.
  ModelUser(Box& box, std::string name);
  virtual ~ModelUser();
  ModelUser(const ModelUser&) = delete;
  ModelUser& operator=(const ModelUser&) = delete;

  const std::string& model_name() const { return name_; }
  // `perf`: what the box's frames cost, at the info outlet.
  void report_perf(const Arguments&) { perf_.report(*info_outlet_); }

 protected:
  // Plays the name's model at once when it is loaded. The built-in model is loaded when no box has
  // loaded it. `info`: the box's info outlet.
  void join(Outlet& info);
  // The model, null before it is there.
  const SharedModel& model() const { return model_; }
  // Before a frame: true with a model. Else the frame is dropped and counted, and the console says
  // once which model the box waits for.
  bool ready_for_frame();

  // Plays a model from now on. It runs between two ticks of Pd's thread, so it must be quick. It
  // throws Error when the model cannot serve; then the console says so, and the model before stays.
  using TakeOver = std::function<void()>;
  // Makes what playing a model needs and takes long to make. It may run on the worker, so it holds
  // copies of all it needs of the box; it may throw Error.
  using Prepare = std::function<TakeOver(const SharedModel& model)>;
  // None: the box makes nothing that takes long, and follow() is called instead.
  virtual Prepare prepare() { return {}; }
  // As a TakeOver.
  virtual void follow(const SharedModel&) {}

  // After every user of the name has taken the model: `ready NAME` at the info outlet.
  virtual void say_ready();

  Box& box() { return box_; }
  Perf& perf() { return perf_; }
  SlowError& slow_error() { return slow_error_; }

 private:
  friend class Models;
  // `take_over`: made on the worker; empty: it is made here.
  void change(const SharedModel& model, TakeOver take_over);

  Box& box_;
  std::string name_;
  SharedModel model_;
  Outlet* info_outlet_ = nullptr;  // of the box, once it has joined
  bool said_waiting_ = false;
  Perf perf_;
  SlowError slow_error_;
};

class Models {
 public:
  static Models& get();

  SharedModel find(const std::string& name) const;
  // Loads the built-in model, unless it is loaded or being loaded.
  void want_demo();
  // Runs `make` on the worker (or here, `blocking`), then all that its users have to prepare. Then,
  // between two ticks, all users of the name change to the new model, and the worker frees the old
  // one. When `make` throws, nothing changes, and `failed` gets the reason on Pd's thread. The
  // result of a load is dropped when a later load of the same name has begun.
  void load(const std::string& name, std::function<SharedModel()> make, bool blocking,
            std::function<void(const std::string& reason)> failed);

 private:
  friend class ModelUser;
  Models();
  struct Loaded;
  void publish(const std::string& name, const Loaded& loaded);
  void add(ModelUser* user);
  void remove(ModelUser* user);
  struct Inside;
  Inside* inside_;
};

}  // namespace gait::pd
