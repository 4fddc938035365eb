// [gait.model NAME FILE]: reads a model and gives it to all boxes of its name.
#include <cstdint>
#include <string>

#include "gait/corpus/demo_model.h"
#include "gait/names.h"
#include "gait/platform/path_text.h"
#include "objects.h"
#include "pd/model_owner.h"

namespace gait::pd {

namespace {

class ModelBox final : public ModelOwner {
 public:
  ModelBox(Box& box, const Arguments& arguments)
      : ModelOwner(box, arguments.is_word(0) ? arguments.text(0) : "", info_),
        ready_(box),
        info_(box) {
    int at = arguments.is_word(0) ? 1 : 0;
    std::string file;
    if (arguments.is_word(at)) file = arguments.symbol(at++);
    for (; at < arguments.size(); ++at) {
      if (arguments.symbol(at) != "-blocking") arguments.fail_at(at, "-blocking");
      background().set_blocking(true);
    }
    bound_ = gensym(
        ("gait.model dialog " + std::to_string(reinterpret_cast<std::uintptr_t>(this))).c_str());
    pd_bind(box.pd(), bound_);
    if (!file.empty())
      read_file(file);
    else if (model_name() == demo_model_name && !Models::get().find(model_name()))
      load(load_demo_model);
    join(info_);
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
      sys_vgui("pdtk_openpanel {%s} {%s}\n", bound_->s_name, canvas_getdir(patch())->s_name);
  }
  // The file dialog's answer.
  void callback(const Arguments& arguments) { read_file(arguments.symbol(0)); }

  void reload(const Arguments& arguments) {
    if (!file_.empty())
      load([path = file_] { return load_model(path_from_utf8(path)); });
    else if (model_name() == demo_model_name)
      load(load_demo_model);
    else
      arguments.fail("expected after a file was read");
  }

  void write(const Arguments& arguments) {
    arguments.expect_count(1);
    if (!model()) arguments.fail("there is no model to write yet");
    write_file(arguments.symbol(0), model()->model);
  }

  void get(const Arguments& arguments) {
    const std::string what = arguments.only().symbol(0);
    for (const char* known : questions)
      if (what == known) {
        if (!model()) arguments.fail("there is no model yet");
        answer(known);
        return;
      }
    arguments.fail_at(0, joined_names(questions));
  }

  void reset(const Arguments&) {}
  void dump(const Arguments&) {
    if (!file_.empty()) info_.add(file_).send("read");
  }
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

  void say_ready() override {
    ModelUser::say_ready();
    ready_.bang();
  }

  // Finds the file on Pd's thread, which owns Pd's search path; the worker reads and checks it.
  void read_file(const std::string& name) {
    const auto path = find_file(patch(), name);
    if (!path) return failed("read: " + no_file(name));
    load([path = *path] { return load_model(path_from_utf8(path)); });
    file_ = *path;
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
  t_symbol* bound_ = nullptr;  // the file dialog's answer comes to this name
  std::string file_;           // read last
};

}  // namespace

void setup_model() {
  Class<ModelBox>("gait.model")
      .bang<&ModelBox::bang>()
      .messages<&ModelBox::read, &ModelBox::callback, &ModelBox::reload, &ModelBox::write,
                &ModelBox::get>({"read", "callback", "reload", "write", "get"})
      .common()
      .refuse_others();
}

}  // namespace gait::pd
