// [gait.pca NAME style]: the style walker's messages.
#include <map>

#include "gait/error.h"
#include "gait/names.h"
#include "gait/play/cycles/style_walker.h"
#include "pca_walking.h"
#include "pd/style_setting.h"

namespace gait::pd {

namespace {

constexpr double most_score = 6;  // deviations

struct StyleSettings {
  StyleSetting styles;
  float variation = 1, exaggeration = 1, cadence = 0;
  bool through_neutral = false;
  std::uint64_t seed = 1;
  std::map<int, float> pins;  // deviations
  bool operator==(const StyleSettings&) const = default;

  void set_styles(StyleWalker& walker, const Model& model) const {
    const std::vector<float> weights = styles.weights(model);
    if (weights.empty() || walker.set_weights(weights)) return;
    std::string cannot;
    for (std::size_t i = 0; i < weights.size(); ++i)
      if (weights[i] > 0 && model.style_space->styles[i].cycles == 0)
        append_name(cannot, model.styles[i]);
    throw Error("no straight cycle of " + cannot + " was captured: it cannot be walked");
  }
};

struct StylePlaying {
  StylePlaying(const StyleSettings& now, const SharedModel& in)
      : settings(now), model(in), walker(*in, now.seed) {
    const Eigen::VectorXd& variances = in->model->style_space->space.variances;
    for (int i = 0; i < walker.components(); ++i)
      per_deviation.push_back(variances[i] > 0 ? static_cast<float>(1 / std::sqrt(variances[i]))
                                               : 0.0f);
    scores.resize(per_deviation.size());
    apply();
  }
  void apply() {
    walker.set_variation(settings.variation);
    walker.set_exaggeration(settings.exaggeration);
    walker.set_through_neutral(settings.through_neutral);
    walker.set_cadence(settings.cadence);
    for (const auto& [score, value] : settings.pins) walker.pin(score, value);
    settings.set_styles(walker, *model->model);
  }
  StyleSettings settings;
  SharedModel model;
  StyleWalker walker;
  std::vector<float> scores, per_deviation;
};

class StyleWalking final : public WalkingBy<StylePlaying> {
 public:
  bool set(const Arguments& arguments) override {
    const Model* model = model_ ? model_->model.get() : nullptr;
    StyleSetting before = settings_.styles;
    if (settings_.styles.take(arguments, model)) {
      try {
        if (playing_) settings_.set_styles(playing_->walker, *model);
      } catch (const Error& error) {
        settings_.styles = std::move(before);
        arguments.fail(error.what());
      }
      return true;
    }
    return set_number(arguments) || set_score(arguments);
  }

  void dump(Outlet& info) const override {
    settings_.styles.dump(info);
    info.add(settings_.variation).send("variation");
    info.add(settings_.exaggeration).send("exaggeration");
    info.add(settings_.through_neutral ? 1 : 0).send("neutral");
    info.add(settings_.cadence).send("cadence");
    info.add(static_cast<double>(settings_.seed)).send("seed");
    for (const auto& [score, value] : settings_.pins) info.add(score).add(value).send("score");
  }

  void reset() noexcept override { playing_->walker.restart(settings_.seed); }
  std::span<const float> scores() noexcept override {
    StylePlaying& now = *playing_;
    for (std::size_t i = 0; i < now.scores.size(); ++i)
      now.scores[i] = now.walker.scores()[static_cast<Eigen::Index>(i)] * now.per_deviation[i];
    return now.scores;
  }
  SpaceOf space_of() const override {
    return [](const Model& model) -> const CycleSpace& { return model.style_space->space; };
  }

 private:
  Make make() const override {
    return [now = settings_](const SharedModel& model) {
      if (!model->has_cycles())
        throw Error("model " + model->model->name +
                    " has no space of styles, so [gait.pca style] cannot walk in it; train it from "
                    "walks whose styles are named");
      return std::make_shared<StylePlaying>(now, model);
    };
  }
  void fit(StylePlaying& fresh, const Model&) const override {
    if (fresh.settings == settings_) return;
    fresh.settings = settings_;
    fresh.apply();
  }

  bool set_number(const Arguments& arguments) {
    const auto selector = arguments.selector();
    if (selector == "variation") {
      settings_.variation = static_cast<float>(arguments.only().number(0, 0, 2));
      if (playing_) playing_->walker.set_variation(settings_.variation);
    } else if (selector == "exaggeration") {
      settings_.exaggeration = static_cast<float>(arguments.only().number(0, -1, 3));
      if (playing_) playing_->walker.set_exaggeration(settings_.exaggeration);
    } else if (selector == "neutral") {
      settings_.through_neutral = arguments.only().flag(0);
      if (playing_) playing_->walker.set_through_neutral(settings_.through_neutral);
    } else if (selector == "cadence") {
      settings_.cadence = static_cast<float>(arguments.only().number(0, 0, 8));
      if (playing_) playing_->walker.set_cadence(settings_.cadence);
    } else if (selector == "seed") {
      settings_.seed = static_cast<std::uint64_t>(arguments.only().integer(0, 0, 16777216));
      if (playing_) playing_->walker.restart(settings_.seed);
    } else {
      return false;
    }
    return true;
  }

  bool set_score(const Arguments& arguments) {
    const auto selector = arguments.selector();
    if (selector != "score" && selector != "pin" && selector != "free") return false;
    if (selector == "free" && arguments.size() == 1 && arguments.is_symbol(0)) {
      if (arguments.symbol(0) != "all") arguments.fail_at(0, "a score's number or 'all'");
      for (const auto& [score, value] : settings_.pins)
        if (playing_) playing_->walker.free(score);
      settings_.pins.clear();
      return true;
    }
    arguments.expect_count(selector == "score" ? 2 : 1);
    const int most = playing_ ? playing_->walker.components() - 1 : 999;
    const int score = arguments.integer(0, 0, most);
    if (selector == "free") {
      settings_.pins.erase(score);
      if (playing_) playing_->walker.free(score);
      return true;
    }
    // `pin` holds a score where it is.
    float value = 0;
    if (selector == "score")
      value = static_cast<float>(arguments.number(1, -most_score, most_score));
    else if (playing_)
      value = scores()[static_cast<std::size_t>(score)];
    else
      arguments.fail("expected after the model " +
                     std::string("is there: nothing can be held yet"));
    settings_.pins[score] = value;
    if (playing_) playing_->walker.pin(score, value);
    return true;
  }

  StyleSettings settings_;
};

}  // namespace

std::unique_ptr<CycleWalking> make_style_walking() { return std::make_unique<StyleWalking>(); }

}  // namespace gait::pd
