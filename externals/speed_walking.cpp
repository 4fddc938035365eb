// [gait.pca NAME speed]: the speed walker's messages.
#include "cycle_walking.h"
#include "gait/error.h"
#include "gait/play/cycles/speed_walker.h"

namespace gait::pd {

namespace {

constexpr std::pair<const char*, SpeedLaw> laws[] = {
    {"fitted", SpeedLaw::fitted}, {"inman", SpeedLaw::inman}, {"feet", SpeedLaw::feet}};

class SpeedWalking final : public CycleWalking {
 public:
  std::function<std::shared_ptr<void>(const SharedModel&)> prepare() const override {
    return [](const SharedModel& model) -> std::shared_ptr<void> {
      if (!model->has_speeds())
        throw Error("model " + model->model->name +
                    " has no walks over speed, so [gait.pca speed] cannot walk in it; train it "
                    "with clips of several speeds");
      return std::make_shared<SpeedWalker>(model->speeds());
    };
  }

  std::shared_ptr<void> take(const SharedModel& model, std::shared_ptr<void> made) override {
    auto walker = std::static_pointer_cast<SpeedWalker>(std::move(made));
    if (!subject_.empty() && walker->set_subject(subject_) == Taken::refused)
      throw Error(no_subject(*walker, subject_, model->model->name));
    walker->set_speed(static_cast<float>(speed_));
    walker->set_cadence(cadence_);
    if (leg_ > 0) walker->set_leg_length(leg_);
    walker->set_law(law_);
    walker->settle();
    if (walker_) walker->scrub(walker_->phase());
    model_ = model;
    std::swap(walker_, walker);
    return walker;
  }

  bool set(const Arguments& arguments) override {
    const auto selector = arguments.selector();
    if (selector == "speed") {
      arguments.expect_count(1);
      speed_ = arguments.number(0);
      if (walker_ && walker_->set_speed(static_cast<float>(speed_)) == Taken::clamped)
        say_clamped(arguments, "0 to " + number_text(10 / 3.6) +
                                   " m/s (10 km/h), less on legs shorter than 0.73 m");
    } else if (selector == "leg") {
      arguments.expect_count(1);
      const double leg = arguments.number(0, 0, 100);
      leg_ = static_cast<float>(leg);
      if (!walker_) return true;
      if (leg_ == 0)
        walker_->set_own_leg_length();
      else if (walker_->set_leg_length(leg_) == Taken::clamped)
        say_clamped(arguments, "0.3 to 1.5 m; 0: the subject's own");
    } else if (selector == "subject") {
      arguments.expect_count(1);
      const std::string subject = arguments.text(0);
      if (walker_ && walker_->set_subject(subject) == Taken::refused)
        arguments.fail(no_subject(*walker_, subject, model_->model->name));
      subject_ = subject;
    } else if (selector == "law") {
      arguments.expect_count(1);
      const std::string name = arguments.symbol(0);
      for (const auto& [word, law] : laws)
        if (name == word) {
          law_ = law;
          if (walker_) walker_->set_law(law);
          return true;
        }
      arguments.fail_at(0, "fitted, inman or feet");
    } else if (selector == "cadence") {
      arguments.expect_count(1);
      cadence_ = static_cast<float>(arguments.number(0, 0, 8));
      if (walker_) walker_->set_cadence(cadence_);
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

  void advance(double seconds) noexcept override { walker_->advance(seconds); }
  void scrub(double phase) noexcept override { walker_->scrub(phase); }
  void reset() noexcept override { walker_->reset(); }
  std::span<const Eigen::Quaternionf> pose() const noexcept override { return walker_->pose(); }
  double phase() const noexcept override { return walker_->phase(); }
  float cadence() const noexcept override { return walker_->cadence(); }
  std::optional<Foot> contact() const noexcept override { return walker_->contact(); }
  SpaceOf space_of() const override {
    return [](const Model& model) -> const CycleSpace& {
      return model.shared_speed_space ? *model.shared_speed_space
                                      : model.speed_spaces.front().space;
    };
  }
  float leg_length() const noexcept override { return walker_->leg_length(); }

 private:
  static std::string no_subject(const SpeedWalker& walker, const std::string& subject,
                                const std::string& model) {
    std::string known;
    for (const SubjectCyclesOverSpeed& one : walker.subjects())
      known += (known.empty() ? "" : ", ") + one.subject;
    return "no subject '" + subject + "' in " + model + "; it has " + known;
  }
  static void say_clamped(const Arguments& arguments, const std::string& range) {
    logpost(nullptr, 2, "gait.pca: %s: %g is clamped to %s",
            std::string(arguments.selector()).c_str(), arguments.number(0), range.c_str());
  }

  SharedModel model_;
  std::shared_ptr<SpeedWalker> walker_;
  double speed_ = 1.2;  // m/s
  float leg_ = 0, cadence_ = 0;
  std::string subject_;
  SpeedLaw law_ = SpeedLaw::feet;
};

}  // namespace

std::unique_ptr<CycleWalking> make_speed_walking() { return std::make_unique<SpeedWalking>(); }

}  // namespace gait::pd
