// The built-in model as the library just built has it, and frames as messages to play in a patch.
#pragma once

#include <cstdio>
#include <memory>
#include <span>
#include <string>

#include "gait/model/model_file.h"

namespace gait::testing {

inline std::shared_ptr<const Model> demo() {
  static const auto model =
      std::make_shared<const Model>(read_model(GAIT_PD_FOLDER "/gait-demo.gait"));
  return model;
}

inline std::string message_of(const std::string& selector, std::span<const float> values) {
  std::string text = selector;
  char number[32];
  for (const float value : values) {
    std::snprintf(number, sizeof number, " %.9g", static_cast<double>(value));
    text += number;
  }
  return text;
}

}  // namespace gait::testing
