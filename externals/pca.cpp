// [gait.pca NAME style|speed]: walks by itself in a space of cycles (T10, G04).
#include "gait/error.h"
#include "gait/play/cycles/cycle_projector.h"
#include "objects.h"
#include "pca_walking.h"
#include "pd/model_player.h"
#include "pd/pose_values.h"
#include "pd/ticker.h"

namespace gait::pd {

namespace {

constexpr double longest_jump = 60;  // seconds: what `advance` takes at once

// What plays a model here, beside the walker.
struct Walk {
  Walk(const SharedModel& played, CycleWalking::TakeOver by, const CycleSpace& in)
      : take_over(std::move(by)),
        model(played->model),
        space(in),
        values(*model->body),
        given(3 * model->body->references.size(), 0.0f) {}
  // Few have another walk projected: that takes memory with its first message.
  CycleProjector& projector() { return projected ? *projected : projected.emplace(model, space); }

  CycleWalking::TakeOver take_over;  // changes to the walker; empty once that is done
  std::shared_ptr<const Model> model;
  const CycleSpace& space;
  PoseValues values;
  std::vector<float> given;
  std::optional<CycleProjector> projected, own;  // own: of a walker that does not know its scores
};

class Pca final : public ModelPlayer<Walk> {
 public:
  Pca(Box& box, const Arguments& arguments)
      : ModelPlayer(box, arguments.size() > 0 ? arguments.text(0) : ""),
        cold_(box, this, &take_cold<Pca>),
        pose_(box),
        info_(box) {
    arguments.expect_count(0, 2);
    const std::string kind = arguments.size() > 1 ? arguments.symbol(1) : "style";
    if (kind != "style" && kind != "speed") arguments.fail_at(1, "style or speed");
    walking_ = kind == "style" ? make_style_walking() : make_speed_walking();
    join(info_);
  }

  void bang(const Arguments&) {
    if (ready_for_frame()) step(1 / model()->model->frame_rate);
  }
  void advance(const Arguments& arguments) {
    const double seconds = arguments.only().number(0, 0, longest_jump);
    if (ready_for_frame()) step(seconds);
  }
  void start(const Arguments&) { run(true); }
  void stop(const Arguments&) { run(false); }
  void number(const Arguments& arguments) { run(arguments.only().flag(0)); }
  void phase(const Arguments& arguments) {
    const double phase = arguments.only().number(0);
    if (!ready_for_frame()) return;
    walking_->scrub(phase - std::floor(phase));
    show();
  }
  // The path turns. [gait.skeleton] turns it, which places the walk in the world.
  void turn(const Arguments& arguments) {
    turn_ = arguments.only().number(0, -10, 10);
    pose_.add(turn_).send("heading");
  }
  void reset(const Arguments&) {
    if (model()) walking_->reset();
    if (playing())
      for (auto* projector : {&playing()->projected, &playing()->own})
        if (*projector) (*projector)->reset();
    leg_sent_ = 0;
  }
  void dump(const Arguments&) {
    walking_->dump(info_);
    info_.add(turn_).send("turn");
  }
  void setting(const Arguments& arguments) {
    if (!walking_->set(arguments)) arguments.fail("no such message");
  }

  // A walk from elsewhere, projected cycle by cycle.
  void cold(const Arguments& arguments) {
    if (arguments.selector() == "pose") {
      if (!ready_for_frame()) return;
      if (!arguments.read(playing()->given) || !playing()->projector().add(playing()->given))
        slow_error().say([&] {
          return "pose: expected " + std::to_string(playing()->given.size()) + " numbers, got " +
                 std::to_string(arguments.size());
        });
    } else if (arguments.selector() == "contact") {
      const std::string foot = arguments.only().symbol(0);
      if (foot != "right" && foot != "left") arguments.fail_at(0, "right or left");
      if (playing() && playing()->projector().contact(foot == "right" ? Foot::right : Foot::left))
        info_.add(playing()->projector().scores()).send("projected");
    } else {
      arguments.fail("no such message at the right inlet");
    }
  }

 private:
  Make make() override {
    return [prepare = walking_->prepare(), space = walking_->space_of()](const SharedModel& model) {
      auto take_over = prepare(model);
      return std::make_shared<Walk>(model, std::move(take_over), space(*model->model));
    };
  }
  void take(const SharedModel& model, Walk& fresh) override {
    fresh.take_over();
    fresh.take_over = nullptr;
    if (walking_->scores().empty()) fresh.own.emplace(fresh.model, fresh.space);
    pose_.reserve(static_cast<int>(fresh.given.size()));
    info_.reserve(fresh.space.kept());
    clock_.set_period(1000 / model->model->frame_rate);
    leg_sent_ = 0;
  }
  void describe() override {
    const Model& learnt = *model()->model;
    std::string styles;
    for (const std::string& style : learnt.styles) styles += " " + style;
    post("%s: walks in %s, %d scores, phase %.3f, cadence %.2f;%s", box().name(),
         learnt.name.c_str(), walking_->space_of()(learnt).kept(), walking_->phase(),
         static_cast<double>(walking_->cadence()), styles.c_str());
  }

  void run(bool on) {
    if (on == clock_.running()) return;
    if (on)
      clock_.start(model() ? 1000 / model()->model->frame_rate : 20);
    else
      clock_.stop();
  }

  void step(double seconds) {
    for (; seconds > CycleWalking::longest_advance; seconds -= CycleWalking::longest_advance)
      move(CycleWalking::longest_advance);
    move(seconds);
    show();
  }

  void move(double seconds) {
    const Perf::Frame frame(perf());
    walking_->advance(seconds);
    const bool known = !playing()->own;
    if (!known) playing()->own->add(playing()->values.of(walking_->pose()));
    const auto contact = walking_->contact();
    if (!contact) return;
    const char* const foot = *contact == Foot::right ? "right" : "left";
    if (known && *contact == Foot::right)
      info_.add(walking_->scores()).send("scores");
    else if (!known && playing()->own->contact(*contact))
      info_.add(playing()->own->scores()).send("scores");
    info_.add(foot).send("step");
    info_.add(foot).send("contact");
  }

  void show() {
    info_.add(walking_->cadence()).send("cadence");
    info_.add(walking_->phase()).send("phase");
    if (const float leg = walking_->leg_length(); leg != leg_sent_) {
      leg_sent_ = leg;
      pose_.add(leg).send("leg");
    }
    pose_.add(playing()->values.of(walking_->pose())).send("pose");
  }

  ColdInlet cold_;
  Outlet pose_, info_;
  std::unique_ptr<CycleWalking> walking_;
  Metronome clock_{[this] {
    if (ready_for_frame()) step(1 / model()->model->frame_rate);
  }};
  double turn_ = 0;  // rad/s
  float leg_sent_ = 0;
};

}  // namespace

void setup_pca() {
  Class<Pca>("gait.pca")
      .walker()
      .messages<&Pca::phase, &Pca::turn>({"phase", "turn"})
      .common()
      .anything<&Pca::setting>();
}

}  // namespace gait::pd
