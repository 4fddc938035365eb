#include "model_argument.h"

namespace gait::tool {

void add_model_argument(CLI::App& command, std::string& model) {
  command.add_option("MODEL", model, "Model file, or gait-demo: the one that is built in")
      ->required()
      ->default_str("")
      ->type_name("");
}

}  // namespace gait::tool
