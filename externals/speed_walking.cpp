// [gait.pca NAME speed]: the speed walker's messages.
#include "cycle_walking.h"
#include "gait/error.h"
#include "gait/names.h"
#include "gait/play/cycles/speed_walker.h"

namespace gait::pd {

namespace {

constexpr std::pair<const char*, SpeedLaw> laws[] = {
    {"fitted", SpeedLaw::fitted}, {"inman", SpeedLaw::inman}, {"feet", SpeedLaw::feet}};

class SpeedWalking final : public CycleWalking {
 public:
  std::function<std::shared_ptr<Walker>(const SharedModel&)> prepare() const override {
    return [](const SharedModel& model) -> std::shared_ptr<Walker> {
      if (!model->has_speeds())
        throw Error("model " + model->model->name +
                    " has no walks over speed, so [gait.pca speed] cannot walk in it; train it "
                    "with clips of several speeds");
      return std::make_shared<Walking>(model->speeds());
    };
  }

  std::shared_ptr<Walker> take(const SharedModel& model, std::shared_ptr<Walker> made) override {
    auto walking = std::static_pointer_cast<Walking>(std::move(made));
    SpeedWalker& walker = walking->walker;
    if (!subject_.empty() && walker.set_subject(subject_) == ControlResult::refused)
      throw Error(no_subject(walker, subject_, model->model->name));
    walker.set_speed(static_cast<float>(speed_));
    walker.set_cadence(cadence_);
    if (leg_ > 0) walker.set_leg_length(leg_);
    walker.set_law(law_);
    walker.settle();
    if (walking_) walker.scrub(walking_->walker.phase());
    model_ = model;
    std::swap(walking_, walking);
    return walking;
  }

  bool set(const Arguments& arguments) override {
    const auto selector = arguments.selector();
    if (selector == "speed") {
      arguments.expect_count(1);
      speed_ = arguments.number(0);
      if (walking_ &&
          walking_->walker.set_speed(static_cast<float>(speed_)) == ControlResult::clamped)
        say_clamped(arguments, "0 to " + number_text(10 / 3.6) +
                                   " m/s (10 km/h), less on legs shorter than 0.73 m");
    } else if (selector == "leg") {
      arguments.expect_count(1);
      const double leg = arguments.number(0, 0, 100);
      leg_ = static_cast<float>(leg);
      if (!walking_) return true;
      if (leg_ == 0)
        walking_->walker.set_own_leg_length();
      else if (walking_->walker.set_leg_length(leg_) == ControlResult::clamped)
        say_clamped(arguments, "0.3 to 1.5 m; 0: the subject's own");
    } else if (selector == "subject") {
      arguments.expect_count(1);
      const std::string subject = arguments.text(0);
      if (walking_ && walking_->walker.set_subject(subject) == ControlResult::refused)
        arguments.fail(no_subject(walking_->walker, subject, model_->model->name));
      subject_ = subject;
    } else if (selector == "law") {
      arguments.expect_count(1);
      const std::string name = arguments.symbol(0);
      for (const auto& [word, law] : laws)
        if (name == word) {
          law_ = law;
          if (walking_) walking_->walker.set_law(law);
          return true;
        }
      arguments.fail_at(0, "fitted, inman or feet");
    } else if (selector == "cadence") {
      arguments.expect_count(1);
      cadence_ = static_cast<float>(arguments.number(0, 0, 8));
      if (walking_) walking_->walker.set_cadence(cadence_);
    } else {
      return false;
    }
    return true;
  }

  void dump(Outlet& info) const override {
    info.add(speed_).send("speed");
    info.add(leg_).send("leg");
    if (!subject_.empty()) info.add_text(subject_).send("subject");
    for (const auto& [word, law] : laws)
      if (law == law_) info.add(word).send("law");
    info.add(cadence_).send("cadence");
  }

  void advance(double seconds) noexcept override { walking_->walker.advance(seconds); }
  void scrub(double phase) noexcept override { walking_->walker.scrub(phase); }
  void reset() noexcept override { walking_->walker.reset(); }
  std::span<const Eigen::Quaternionf> pose() const noexcept override {
    return walking_->walker.pose();
  }
  double phase() const noexcept override { return walking_->walker.phase(); }
  float cadence() const noexcept override { return walking_->walker.cadence(); }
  std::optional<Foot> contact() const noexcept override { return walking_->walker.contact(); }
  SpaceOf space_of() const override {
    return [](const Model& model) -> const CycleSpace& {
      return model.shared_speed_space ? *model.shared_speed_space
                                      : model.speed_spaces.front().space;
    };
  }
  float leg_length() const noexcept override { return walking_->walker.leg_length(); }

 private:
  struct Walking final : Walker {
    explicit Walking(std::shared_ptr<const SpeedTables> tables) : walker(std::move(tables)) {}
    SpeedWalker walker;
  };

  static std::string no_subject(const SpeedWalker& walker, const std::string& subject,
                                const std::string& model) {
    return "no subject '" + subject + "' in " + model + "; it has " +
           joined_names(walker.subjects(), &SubjectCyclesOverSpeed::subject);
  }
  static void say_clamped(const Arguments& arguments, const std::string& range) {
    logpost(nullptr, 2, "gait.pca: %s: %g is clamped to %s",
            std::string(arguments.selector()).c_str(), arguments.number(0), range.c_str());
  }

  SharedModel model_;
  std::shared_ptr<Walking> walking_;
  double speed_ = 1.2;  // m/s
  float leg_ = 0, cadence_ = 0;
  std::string subject_;
  SpeedLaw law_ = SpeedLaw::feet;
};

}  // namespace

std::unique_ptr<CycleWalking> make_speed_walking() { return std::make_unique<SpeedWalking>(); }

}  // namespace gait::pd
