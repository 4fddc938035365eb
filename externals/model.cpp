// [gait.model NAME FILE]: owns a model by name; others of that name listen.
#include <filesystem>
#include <fstream>

#include "gait/corpus/demo_model.h"
#include "gait/error.h"
#include "gait/model/model_file.h"
#include "gait/names.h"
#include "objects.h"
#include "pd/models.h"
#include "pd/worker.h"

namespace gait::pd {

namespace {

class ModelBox final : public ModelUser {
 public:
  ModelBox(Box& box, const Arguments& arguments)
      : ModelUser(box, arguments.size() > 0 && !is_flag(arguments, 0) ? arguments.text(0) : ""),
        ready_(box),
        info_(box),
        canvas_(canvas_getcurrent()) {
    int at = arguments.size() > 0 && !is_flag(arguments, 0) ? 1 : 0;
    std::string file;
    if (at < arguments.size() && !is_flag(arguments, at)) file = arguments.symbol(at++);
    for (; at < arguments.size(); ++at) {
      if (arguments.symbol(at) != "-blocking") arguments.fail_at(at, "-blocking");
      blocking_ = true;
    }
    bound_ = gensym(
        ("gait.model dialog " + std::to_string(reinterpret_cast<std::uintptr_t>(this))).c_str());
    pd_bind(box.pd(), bound_);
    if (!file.empty())
      read_file(file);
    else if (model_name() == demo_model_name && !Models::get().find(model_name()))
      load(load_demo_model);
    join();
  }
  ~ModelBox() override { pd_unbind(box().pd(), bound_); }

  void bang(const Arguments&) {
    if (!model()) {
      info_.add("no model yet").send("failed");
      return;
    }
    for (const char* what : questions) answer(what);
  }

  void read(const Arguments& arguments) {
    arguments.expect_count(0, 1);
    if (arguments.size() == 1)
      read_file(arguments.symbol(0));
    else
      sys_vgui("pdtk_openpanel {%s} {%s}\n", bound_->s_name, canvas_getdir(canvas_)->s_name);
  }
  // What the file dialog sends.
  void callback(const Arguments& arguments) { read_file(arguments.symbol(0)); }

  void reload(const Arguments&) {
    if (!file_.empty())
      load([path = file_] { return load_model(path); });
    else if (model_name() == demo_model_name)
      load(load_demo_model);
    else
      throw Error("gait.model: reload: expected after a file was read");
  }

  void write(const Arguments& arguments) {
    arguments.expect_count(1);
    if (!model()) throw Error("gait.model: write: there is no model to write yet");
    char path[MAXPDSTRING];
    canvas_makefilename(canvas_, arguments.symbol(0).c_str(), path, MAXPDSTRING);
    struct Result {
      std::string reason;
    };
    const auto result = std::make_shared<Result>();
    Worker::get().run(
        [result, to = std::string(path), what = model()->model] {
          try {
            write_model(*what, to);
          } catch (const std::exception& error) {
            result->reason = error.what();
          }
        },
        [this, alive = std::weak_ptr<bool>(alive_), result, to = std::string(path)] {
          if (alive.expired()) return;
          if (result->reason.empty())
            info_.add(to).send("written");
          else
            failed("write: " + result->reason);
        },
        blocking_);
  }

  void get(const Arguments& arguments) {
    arguments.expect_count(1);
    const std::string what = arguments.symbol(0);
    for (const char* known : questions)
      if (what == known) {
        if (!model()) throw Error("gait.model: get: there is no model yet");
        answer(known);
        return;
      }
    arguments.fail_at(0, joined_names(questions));
  }

  void reset(const Arguments&) {}
  void dump(const Arguments&) {
    if (!file_.empty()) info_.add(file_).send("read");
  }
  void unknown(const Arguments& arguments) { arguments.fail("no such message"); }
  void report_perf(const Arguments&) { perf().report(info_); }
  void print(const Arguments&) {
    if (!model()) {
      post("gait.model: %s is not there yet", model_name().c_str());
      return;
    }
    const Model& learnt = *model()->model;
    post("gait.model: %s: model %s%s, %g frames per second, %d input values, %d output values",
         model_name().c_str(), learnt.name.c_str(), learnt.training.synthetic ? " (synthetic)" : "",
         learnt.frame_rate, learnt.input.values, learnt.output.values);
    if (!learnt.training.comment.empty()) post("  %s", learnt.training.comment.c_str());
  }

 private:
  static constexpr const char* questions[] = {"joints", "inputs", "outputs", "parents", "styles",
                                              "labels", "sizes",  "obs",     "rate",    "engines"};

  static bool is_flag(const Arguments& arguments, int i) {
    return arguments.is_symbol(i) && arguments.symbol(i).starts_with('-');
  }

  void say_ready() override {
    info_.add_text(model_name()).send("ready");
    ready_.bang();
  }

  void failed(const std::string& reason) {
    const std::string line = "gait.model: " + reason;
    say_error(box(), line.c_str());
    info_.add(reason).send("failed");
  }

  void load(std::function<SharedModel()> make) {
    Models::get().load(model_name(), std::move(make), blocking_,
                       [this, alive = std::weak_ptr<bool>(alive_)](const std::string& reason) {
                         if (!alive.expired()) failed(reason);
                       });
  }

  // The file is looked for on Pd's thread and its paths, read and checked on the worker.
  void read_file(const std::string& name) {
    char folder[MAXPDSTRING], *file = nullptr;
    const int found = canvas_open(canvas_, name.c_str(), "", folder, &file, MAXPDSTRING, 1);
    if (found < 0) {
      failed("read: no file '" + name + "' beside the patch or on Pd's path");
      return;
    }
    sys_close(found);
    const std::string path = std::string(folder) + "/" + file;
    load([this_file = path] { return load_model(this_file); });
    file_ = path;
  }

  void answer(const std::string& what) {
    const Model& learnt = *model()->model;
    const auto names = [&](const std::vector<Stream>& streams) {
      for (const Stream& stream : streams) info_.add_text(stream.name);
    };
    if (what == "joints") {
      if (learnt.body)
        for (const Joint& joint : learnt.body->skeleton.joints) info_.add_text(joint.name);
    } else if (what == "inputs") {
      names(learnt.inputs);
    } else if (what == "outputs") {
      names(learnt.outputs);
    } else if (what == "parents") {
      if (learnt.body)
        for (const Joint& joint : learnt.body->skeleton.joints) info_.add(joint.parent);
    } else if (what == "styles") {
      for (const std::string& style : learnt.styles) info_.add_text(style);
    } else if (what == "labels") {
      for (const Label& label : learnt.labels) info_.add_text(label.name);
    } else if (what == "sizes") {
      info_.add(learnt.input.values)
          .add(learnt.output.values)
          .add(learnt.body ? 3 * learnt.body->skeleton.size() : 0);
    } else if (what == "obs") {
      // Which value each entry of an observation is of, and how many frames back it is compared.
      for (const int value : learnt.input.modelled) info_.add(value).add(0);
      for (const int lag : learnt.input.lags)
        for (const int value : learnt.input.modelled) info_.add(value).add(lag);
    } else if (what == "rate") {
      info_.add(learnt.frame_rate);
    } else if (what == "engines") {
      if (!learnt.labels.empty()) info_.add("viterbi").add("map");
      if (model()->has_steps()) info_.add("synth");
      if (model()->has_cycles()) info_.add("style");
      if (model()->has_speeds()) info_.add("speed");
    }
    info_.send(what.c_str());
  }

  Outlet ready_, info_;
  const t_glist* canvas_;
  t_symbol* bound_ = nullptr;
  bool blocking_ = false;
  std::string file_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
};

}  // namespace

void setup_model() {
  Class<ModelBox>("gait.model")
      .bang<&ModelBox::bang>()
      .message<&ModelBox::read>("read")
      .message<&ModelBox::callback>("callback")
      .message<&ModelBox::reload>("reload")
      .message<&ModelBox::write>("write")
      .message<&ModelBox::get>("get")
      .common()
      .anything<&ModelBox::unknown>();
}

}  // namespace gait::pd
