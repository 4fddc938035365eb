#include "gait/model/fitted_model.h"

namespace gait {

std::shared_ptr<const Model> fitted_model(const Model& model, const Skeleton& skeleton,
                                          const std::vector<int>& matched) {
  auto fitted = std::make_shared<Model>(model);
  for (int joint = 0; joint < fitted->body->skeleton.size(); ++joint) {
    if (matched[joint] < 0) continue;
    fitted->body->skeleton.joints[joint].offset = skeleton.joints[matched[joint]].offset;
    fitted->body->skeleton.joints[joint].tips = skeleton.joints[matched[joint]].tips;
  }
  return fitted;
}

}  // namespace gait
