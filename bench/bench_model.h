// A model of the size the figures speak of, learnt from generated movement: 22 joints, 12 of them
// measured (144 input dimensions), 9 synthesised (27 output values), 15 styles.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "gait/model/model.h"

namespace gait::bench {

// `states` per label. The same model every time.
std::shared_ptr<const Model> bench_model(int states);

// Input poses of one walk at the model's rate, frame after frame.
std::vector<std::vector<Eigen::Quaternionf>> bench_inputs(const Model& model, int frames);

}  // namespace gait::bench
