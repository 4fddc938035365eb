// [gait.bvh NAME FILE -poly n]: plays clips of motion on a model's body, and records motion.
#include <memory>
#include <vector>

#include "bvh_voice.h"
#include "gait/error.h"
#include "objects.h"

namespace gait::pd {

namespace {

class Bvh final : public ModelUser {
 public:
  Bvh(Box& box, const Arguments& arguments)
      : ModelUser(box, arguments.is_word(0) ? arguments.text(0) : ""),
        cold_(box, this, &take_cold<Bvh>),
        in_(box),
        pose_(box),
        info_(box) {
    int at = arguments.is_word(0) ? 1 : 0;
    std::string clip;
    if (arguments.is_word(at)) clip = arguments.symbol(at++);
    int voices = 0;
    bool blocking = false;
    for (; at < arguments.size(); ++at) {
      const std::string flag = arguments.symbol(at);
      if (flag == "-blocking")
        blocking = true;
      else if (flag == "-poly")
        voices = arguments.integer(++at, 1, most_voices);
      else
        arguments.fail_at(at, "-poly n or -blocking");
    }
    const BvhVoice::Around around{
        box, in_, pose_, info_, perf(), slow_error(), canvas_getcurrent(), blocking, [this] {
          return ready_for_frame();
        }};
    poly_ = voices > 0;
    for (int i = 0; i < std::max(1, voices); ++i)
      voices_.push_back(std::make_unique<BvhVoice>(around, poly_ ? i : -1, ""));
    if (!clip.empty()) {
      t_atom atom;
      SETSYMBOL(&atom, gensym(clip.c_str()));
      for (const auto& voice : voices_) voice->message(Arguments(box.name(), "open", 1, &atom));
    }
    join(info_);
  }

  void bang(const Arguments&) {
    for (const auto& voice : voices_) voice->bang();
  }
  // 1 or 0; with -poly also any message after a performer's number.
  void list(const Arguments& arguments) {
    if (poly_ && arguments.size() > 1) {
      BvhVoice& voice = voice_of(arguments);
      const Arguments rest = without_number(arguments);
      if (rest.selector() == "bang")
        voice.bang();
      else if (rest.selector() == "list")
        voice.run(rest.flag(0));
      else
        one(voice, rest);
      return;
    }
    const bool on = arguments.only().flag(0);
    for (const auto& voice : voices_) voice->run(on);
  }
  void anything(const Arguments& arguments) {
    for (const auto& voice : voices_) one(*voice, arguments);
  }
  void cold(const Arguments& arguments) {
    if (!ready_for_frame()) return;
    if (!poly_)
      voices_.front()->cold(arguments);
    else if (arguments.selector() == "list" && arguments.size() > 1)
      voice_of(arguments).cold(without_number(arguments));
    else
      arguments.fail("expected a performer's number first");
  }

 private:
  BvhVoice& voice_of(const Arguments& arguments) {
    return *voices_[arguments.integer(0, 0, static_cast<int>(voices_.size()) - 1)];
  }
  Arguments without_number(const Arguments& arguments) {
    const bool selector = arguments.is_symbol(1);
    const auto atoms = arguments.atoms().subspan(selector ? 2 : 1);
    return Arguments(box().name(), selector ? arguments.atoms()[1].a_w.w_symbol->s_name : "list",
                     static_cast<int>(atoms.size()), atoms.data());
  }
  static void one(BvhVoice& voice, const Arguments& arguments) {
    if (!voice.message(arguments)) arguments.fail("no such message");
  }

  void follow(const SharedModel& model) override {
    if (!model->model->body)
      throw Error("model " + model->model->name +
                  " has no body, so [gait.bvh] cannot play clips on it: its streams are plain");
    for (const auto& voice : voices_) voice->take(model);
    const int values = 3 * model->model->body->skeleton.size() + 2;
    for (Outlet* outlet : {&in_, &pose_, &info_}) outlet->reserve(values);
  }
  void say_ready() override {
    for (const auto& voice : voices_) voice->say_ready(model_name());
  }

  ColdInlet cold_;
  Outlet in_, pose_, info_;
  bool poly_ = false;
  std::vector<std::unique_ptr<BvhVoice>> voices_;
};

}  // namespace

void setup_bvh() {
  Class<Bvh>("gait.bvh")
      .bang<&Bvh::bang>()
      .list<&Bvh::list>()
      .message<&Bvh::report_perf>("perf")
      .anything<&Bvh::anything>();
}

}  // namespace gait::pd
