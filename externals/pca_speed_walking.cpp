// [gait.pca NAME speed]: the speed walker's messages.
#include "gait/error.h"
#include "gait/names.h"
#include "gait/play/cycles/speed_walker.h"
#include "pca_walking.h"

namespace gait::pd {

namespace {

constexpr std::pair<const char*, SpeedLaw> laws[] = {
    {"fitted", SpeedLaw::fitted}, {"inman", SpeedLaw::inman}, {"feet", SpeedLaw::feet}};

struct SpeedPlaying {
  SpeedWalker walker;
};

class SpeedWalking final : public WalkingBy<SpeedPlaying> {
 public:
  bool set(const Arguments& arguments) override {
    const auto selector = arguments.selector();
    if (selector == "speed") {
      speed_ = arguments.only().number(0);
      if (playing_ &&
          playing_->walker.set_speed(static_cast<float>(speed_)) == ControlResult::clamped)
        say_clamped(arguments, "0 to " + number_text(10 / 3.6) +
                                   " m/s (10 km/h), less on legs shorter than 0.73 m");
    } else if (selector == "leg") {
      const double leg = arguments.only().number(0, 0, 100);
      leg_ = static_cast<float>(leg);
      if (!playing_) return true;
      if (leg_ == 0)
        playing_->walker.set_own_leg_length();
      else if (playing_->walker.set_leg_length(leg_) == ControlResult::clamped)
        say_clamped(arguments, "0.3 to 1.5 m; 0: the subject's own");
    } else if (selector == "subject") {
      const std::string subject = arguments.only().text(0);
      if (playing_ && playing_->walker.set_subject(subject) == ControlResult::refused)
        arguments.fail(no_subject(playing_->walker, subject, model_->model->name));
      subject_ = subject;
    } else if (selector == "law") {
      const std::string name = arguments.only().symbol(0);
      for (const auto& [word, law] : laws)
        if (name == word) {
          law_ = law;
          if (playing_) playing_->walker.set_law(law);
          return true;
        }
      arguments.fail_at(0, "fitted, inman or feet");
    } else if (selector == "cadence") {
      cadence_ = static_cast<float>(arguments.only().number(0, 0, 8));
      if (playing_) playing_->walker.set_cadence(cadence_);
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

  void reset() noexcept override { playing_->walker.reset(); }
  SpaceOf space_of() const override {
    return [](const Model& model) -> const CycleSpace& {
      return model.shared_speed_space ? *model.shared_speed_space
                                      : model.speed_spaces.front().space;
    };
  }
  float leg_length() const noexcept override { return playing_->walker.leg_length(); }

 private:
  Make make() const override {
    return [](const SharedModel& model) {
      if (!model->has_speeds())
        throw Error("model " + model->model->name +
                    " has no walks over speed, so [gait.pca speed] cannot walk in it; train it "
                    "with clips of several speeds");
      return std::make_shared<SpeedPlaying>(SpeedPlaying{SpeedWalker(model->speeds())});
    };
  }
  void fit(SpeedPlaying& fresh, const Model& model) const override {
    SpeedWalker& walker = fresh.walker;
    if (!subject_.empty() && walker.set_subject(subject_) == ControlResult::refused)
      throw Error(no_subject(walker, subject_, model.name));
    walker.set_speed(static_cast<float>(speed_));
    walker.set_cadence(cadence_);
    if (leg_ > 0) walker.set_leg_length(leg_);
    walker.set_law(law_);
    walker.settle();
  }

  static std::string no_subject(const SpeedWalker& walker, const std::string& subject,
                                const std::string& model) {
    return "no subject '" + subject + "' in " + model + "; it has " +
           joined_names(walker.subjects(), &SubjectCyclesOverSpeed::subject);
  }
  static void say_clamped(const Arguments& arguments, const std::string& range) {
    logpost(nullptr, 2, "gait.pca: %s: %g is clamped to %s",
            std::string(arguments.selector()).c_str(), arguments.number(0), range.c_str());
  }

  double speed_ = 1.2;  // m/s
  float leg_ = 0, cadence_ = 0;
  std::string subject_;
  SpeedLaw law_ = SpeedLaw::feet;
};

}  // namespace

std::unique_ptr<CycleWalking> make_speed_walking() { return std::make_unique<SpeedWalking>(); }

}  // namespace gait::pd
