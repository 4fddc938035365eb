#include "style_setting.h"

#include <algorithm>

#include "gait/error.h"
#include "gait/names.h"

namespace gait::pd {

namespace {

constexpr double most_weight = 1e6;

double weight_at(const Arguments& arguments, int i) { return arguments.number(i, 0, most_weight); }

void expect_some(const Arguments& arguments, double sum) {
  if (!(sum > 0)) arguments.fail("expected at least one weight above zero");
}

}  // namespace

bool StyleSetting::take(const Arguments& arguments, const Model* model) {
  StyleSetting next = *this;
  if (arguments.selector() == "style") {
    next.clear();
    if (arguments.size() == 1) {
      next.mix_ = {{arguments.text(0), 1}};
    } else {
      if (arguments.size() == 0 || arguments.size() % 2 != 0)
        arguments.fail("expected a style, or styles each with a weight");
      double sum = 0;
      for (int i = 0; i < arguments.size(); i += 2) {
        next.mix_.emplace_back(arguments.text(i), weight_at(arguments, i + 1));
        sum += next.mix_.back().second;
      }
      expect_some(arguments, sum);
    }
  } else if (arguments.selector() == "weight") {
    arguments.expect_count(2);
    const std::string name = arguments.text(0);
    const double weight = weight_at(arguments, 1);
    if (!next.by_order_.empty() && model != nullptr &&
        next.by_order_.size() == model->styles.size())
      for (std::size_t i = 0; i < next.by_order_.size(); ++i)
        next.mix_.emplace_back(model->styles[i], next.by_order_[i]);
    next.by_order_.clear();
    const auto at = std::ranges::find(next.mix_, name, &std::pair<std::string, double>::first);
    if (at == next.mix_.end())
      next.mix_.emplace_back(name, weight);
    else
      at->second = weight;
    double sum = 0;
    for (const auto& [style, share] : next.mix_) sum += share;
    expect_some(arguments, sum);
  } else if (arguments.selector() == "styles") {
    next.clear();
    double sum = 0;
    for (int i = 0; i < arguments.size(); ++i) {
      next.by_order_.push_back(weight_at(arguments, i));
      sum += next.by_order_.back();
    }
    expect_some(arguments, sum);
  } else {
    return false;
  }
  if (model != nullptr) {
    try {
      next.weights(*model);
    } catch (const Error& error) {
      arguments.fail(error.what());
    }
  }
  *this = std::move(next);
  return true;
}

std::vector<float> StyleSetting::weights(const Model& model) const {
  std::vector<float> weights;
  if (mix_.empty() && by_order_.empty()) return weights;
  if (!by_order_.empty()) {
    if (by_order_.size() != model.styles.size())
      throw Error("expected " + std::to_string(model.styles.size()) +
                  " weights, one per style of " + model.name + ", got " +
                  std::to_string(by_order_.size()));
    weights.assign(by_order_.begin(), by_order_.end());
    return weights;
  }
  weights.assign(model.styles.size(), 0);
  for (const auto& [name, weight] : mix_) {
    const auto at = std::ranges::find(model.styles, name);
    if (at == model.styles.end())
      throw Error("no style '" + name + "' in " + model.name + "; it has " +
                  (model.styles.empty() ? "none" : joined_names(model.styles)));
    weights[static_cast<std::size_t>(at - model.styles.begin())] += static_cast<float>(weight);
  }
  return weights;
}

void StyleSetting::dump(Outlet& info) const {
  if (!by_order_.empty()) {
    for (const double weight : by_order_) info.add(weight);
    info.send("styles");
  } else if (!mix_.empty()) {
    for (const auto& [name, weight] : mix_) info.add_text(name).add(weight);
    info.send("style");
  }
}

}  // namespace gait::pd
