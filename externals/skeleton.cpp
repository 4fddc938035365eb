// [gait.skeleton NAME]: puts the body together from its parts and places it in the world by its
// feet.
#include "gait/play/body/body_stage.h"
#include "objects.h"
#include "pd/model_player.h"
#include "skeleton_setting.h"

namespace gait::pd {

namespace {

class Skeleton final : public ModelPlayer<BodyStage> {
 public:
  Skeleton(Box& box, const Arguments& arguments)
      : ModelPlayer(box, arguments.size() > 0 ? arguments.text(0) : ""),
        cold_(box, this, &take_cold<Skeleton>),
        figure_(box),
        body_(box),
        info_(box) {
    arguments.expect_count(0, 1);
    join(info_);
  }

  void out(const Arguments& arguments) {
    if (!ready_for_frame()) return;
    if (show_frame(arguments, outputs_, [this] { return playing()->show_outputs(outputs_); }))
      show();
  }
  void pose(const Arguments& arguments) {
    if (!ready_for_frame()) return;
    if (show_frame(arguments, pose_, [this] { return playing()->show_pose(pose_); })) show();
  }
  // What was measured: it is shown together with the outputs that are made from it.
  void cold(const Arguments& arguments) {
    const auto selector = arguments.selector();
    if (selector == "in") {
      if (ready_for_frame())
        take_frame(arguments, inputs_, [this] { return playing()->store_inputs(inputs_); });
    } else if (selector == "pose") {
      if (ready_for_frame())
        take_frame(arguments, pose_, [this] { return playing()->store_pose(pose_); });
    } else if (selector == "root") {
      store_root(arguments);
    } else if (selector != "mask" && selector != "plain") {  // [gait.osc] sends them beside `in`
      arguments.fail("no such message at the right inlet");
    }
  }

  // A setting, or where the root was measured.
  void root(const Arguments& arguments) {
    if (arguments.is_symbol(0))
      setting(arguments);
    else
      store_root(arguments);
  }
  void setting(const Arguments& arguments) {
    if (!settings_.take(arguments, playing().get())) arguments.fail("no such message");
  }
  // [gait.synth] passes `stream` on. Nothing has to be done: a walk by itself sends whole poses.
  void stream(const Arguments& arguments) { arguments.only().flag(0); }

  void resend(const Arguments&) { send_bones(); }
  void reset(const Arguments&) {
    if (playing()) playing()->reset();
  }
  void dump(const Arguments&) { settings_.dump(info_); }

 private:
  void describe() override {
    const auto& hips = playing()->root().hips;
    post("%s: %s, %d joints, hips at %.2f %.2f %.2f m", box().name(), model()->model->name.c_str(),
         static_cast<int>(pose_.size() / 3), static_cast<double>(hips.x()),
         static_cast<double>(hips.y()), static_cast<double>(hips.z()));
  }
  Make make() override {
    return [](const SharedModel& shared) { return std::make_shared<BodyStage>(shared->model); };
  }
  void take(const SharedModel& shared, BodyStage& fresh) override {
    if (playing()) fresh.take_over(*playing());
    const Model& model = *shared->model;
    inputs_.assign(static_cast<std::size_t>(model.input.values), 0);
    outputs_.assign(static_cast<std::size_t>(model.output.values), 0);
    pose_.assign(fresh.pose().size(), 0);
    // Pd takes memory for a word it has not heard yet: not at frame rate.
    for (const char* word : {"bones", "pos", "root", "pose", "energy", "contact", "right", "left",
                             "stride", "joint", "speed"})
      gensym(word);
    figure_.reserve(static_cast<int>(fresh.positions().size()));
    body_.reserve(static_cast<int>(pose_.size()));
    settings_.apply(fresh, [this](const std::string& what) { say_error(box(), what); });
    bones_due_ = true;
  }
  void say_ready() override {
    ModelUser::say_ready();
    send_bones();
    // Once more with the first frame: in a patch that Pd is still reading, cords come later.
    bones_due_ = true;
  }

  template <class Take>
  bool take_frame(const Arguments& arguments, std::vector<float>& values, Take taken) {
    if (arguments.read(values) && taken()) return true;
    slow_error().say([&] {
      return std::string(arguments.selector()) + ": expected " + std::to_string(values.size()) +
             " finite numbers, got " + std::to_string(arguments.size());
    });
    return false;
  }

  // The same for a frame that is shown: counts what it costs, or that it was dropped.
  template <class Take>
  bool show_frame(const Arguments& arguments, std::vector<float>& values, Take taken) {
    Perf::Frame frame(perf());
    if (take_frame(arguments, values, taken)) return true;
    frame.forget();
    perf().drop();
    return false;
  }

  void store_root(const Arguments& arguments) {
    if (!ready_for_frame()) return;
    take_frame(arguments, root_, [this] {
      return playing()->store_root({{root_[0], root_[1], root_[2]}, root_[3]});
    });
  }

  void send_bones() {
    if (!playing()) return;
    for (const auto& [parent, child] : playing()->bones()) figure_.add(parent).add(child);
    figure_.send("bones");
    bones_due_ = false;
  }

  void show() {
    for (const auto& [joint, said] : settings_.reported()) {
      const auto at = static_cast<std::size_t>(3 * joint);
      info_.add_text(said).add(playing()->speed(joint)).send("speed");
      info_.add_text(said).add(playing()->positions().subspan(at, 3)).send("joint");
    }
    info_.add(playing()->energy()).send("energy");
    for (const Foot foot : {Foot::right, Foot::left}) {
      if (!playing()->touched(foot)) continue;
      if (const auto stride = playing()->stride(foot)) info_.add(*stride).send("stride");
      info_.add(foot == Foot::right ? "right" : "left").send("contact");
    }
    const RootPlace& root = playing()->root();
    body_.add(root.hips.x()).add(root.hips.y()).add(root.hips.z()).add(root.heading).send("root");
    body_.add(playing()->pose()).send("pose");
    if (bones_due_) send_bones();
    figure_.add(playing()->positions()).send("pos");
  }

  ColdInlet cold_;
  Outlet figure_, body_, info_;
  std::vector<float> inputs_, outputs_, pose_, root_ = std::vector<float>(4);
  bool bones_due_ = false;
  SkeletonSetting settings_;
};

}  // namespace

void setup_skeleton() {
  Class<Skeleton>("gait.skeleton")
      .messages<&Skeleton::out, &Skeleton::pose, &Skeleton::root, &Skeleton::stream,
                &Skeleton::resend>({"out", "pose", "root", "stream", "resend"})
      .common()
      .anything<&Skeleton::setting>();
}

}  // namespace gait::pd
