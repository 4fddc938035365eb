// [gait.pca NAME style]: the style walker's messages.
#include <map>

#include "cycle_walking.h"
#include "gait/error.h"
#include "gait/play/style_walker.h"
#include "style_setting.h"

namespace gait::pd {

namespace {

constexpr double most_score = 6;  // deviations

class StyleWalking final : public CycleWalking {
 public:
  void take(const SharedModel& model) override {
    if (!model->cycles)
      throw Error("model " + model->model->name +
                  " has no space of styles, so [gait.pca style] cannot walk in it; train it from "
                  "walks whose styles are named");
    auto walker = std::make_unique<StyleWalker>(model->model, seed_, model->cycles);
    walker->set_variation(variation_);
    walker->set_exaggeration(exaggeration_);
    walker->set_through_neutral(through_neutral_);
    walker->set_cadence(cadence_);
    for (const auto& [score, value] : pins_) walker->pin(score, value);
    set_styles(*walker, *model->model);
    if (walker_) walker->scrub(walker_->phase());
    model_ = model;
    walker_ = std::move(walker);
  }

  bool set(const Arguments& arguments) override {
    const Model* model = model_ ? model_->model.get() : nullptr;
    StyleSetting before = styles_;
    if (styles_.take(arguments, model)) {
      try {
        if (walker_) set_styles(*walker_, *model);
      } catch (const Error& error) {
        styles_ = std::move(before);
        arguments.fail(error.what());
      }
      return true;
    }
    return set_number(arguments) || set_score(arguments);
  }

  void dump(Outlet& info) const override {
    styles_.dump(info);
    info.add(variation_).send("variation");
    info.add(exaggeration_).send("exaggeration");
    info.add(through_neutral_ ? 1 : 0).send("neutral");
    info.add(cadence_).send("cadence");
    info.add(static_cast<double>(seed_)).send("seed");
    for (const auto& [score, value] : pins_) info.add(score).add(value).send("score");
  }

  void advance(double seconds) noexcept override { walker_->advance(seconds); }
  void scrub(double phase) noexcept override { walker_->scrub(phase); }
  void reset() noexcept override { walker_->restart(seed_); }
  std::span<const Eigen::Quaternionf> pose() const noexcept override { return walker_->pose(); }
  double phase() const noexcept override { return walker_->phase(); }
  float cadence() const noexcept override { return walker_->cadence(); }
  std::optional<Foot> contact() const noexcept override { return walker_->contact(); }
  const CycleSpace& space() const noexcept override { return model_->model->style_space->space; }

 private:
  void set_styles(StyleWalker& walker, const Model& model) const {
    const std::vector<float> weights = styles_.weights(model);
    if (weights.empty() || walker.set_weights(weights)) return;
    std::string cannot;
    for (std::size_t i = 0; i < weights.size(); ++i)
      if (weights[i] > 0 && model.style_space->styles[i].cycles == 0)
        cannot += (cannot.empty() ? "" : ", ") + model.styles[i];
    throw Error("no straight cycle of " + cannot + " was captured: it cannot be walked");
  }

  bool set_number(const Arguments& arguments) {
    const auto selector = arguments.selector();
    if (selector == "variation") {
      arguments.expect_count(1);
      variation_ = static_cast<float>(arguments.number(0, 0, 2));
      if (walker_) walker_->set_variation(variation_);
    } else if (selector == "exaggeration") {
      arguments.expect_count(1);
      exaggeration_ = static_cast<float>(arguments.number(0, -1, 3));
      if (walker_) walker_->set_exaggeration(exaggeration_);
    } else if (selector == "neutral") {
      arguments.expect_count(1);
      through_neutral_ = arguments.flag(0);
      if (walker_) walker_->set_through_neutral(through_neutral_);
    } else if (selector == "cadence") {
      arguments.expect_count(1);
      cadence_ = static_cast<float>(arguments.number(0, 0, 8));
      if (walker_) walker_->set_cadence(cadence_);
    } else if (selector == "seed") {
      arguments.expect_count(1);
      seed_ = static_cast<std::uint64_t>(arguments.integer(0, 0, 16777216));
      if (walker_) walker_->restart(seed_);
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
      for (const auto& [score, value] : pins_)
        if (walker_) walker_->free(score);
      pins_.clear();
      return true;
    }
    arguments.expect_count(selector == "score" ? 2 : 1);
    const int most = walker_ ? walker_->components() - 1 : 999;
    const int score = arguments.integer(0, 0, most);
    if (selector == "free") {
      pins_.erase(score);
      if (walker_) walker_->free(score);
      return true;
    }
    // `pin` holds a score where it is.
    float value = 0;
    if (selector == "score")
      value = static_cast<float>(arguments.number(1, -most_score, most_score));
    else if (walker_)
      value = scores_now(score);
    else
      arguments.fail("expected after the model " +
                     std::string("is there: nothing can be held yet"));
    pins_[score] = value;
    if (walker_) walker_->pin(score, value);
    return true;
  }

  float scores_now(int score) const {
    const double deviation = std::sqrt(space().variances[score]);
    return deviation > 0 ? static_cast<float>(walker_->scores()[score] / deviation) : 0.0f;
  }

  SharedModel model_;
  std::unique_ptr<StyleWalker> walker_;
  StyleSetting styles_;
  float variation_ = 1, exaggeration_ = 1, cadence_ = 0;
  bool through_neutral_ = false;
  std::uint64_t seed_ = 1;
  std::map<int, float> pins_;  // deviations
};

}  // namespace

std::unique_ptr<CycleWalking> make_style_walking() { return std::make_unique<StyleWalking>(); }

}  // namespace gait::pd
