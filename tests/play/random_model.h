// Models of plain streams with random states: nothing to recognise, everything to compute.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "gait/model/model.h"

namespace gait::testing {

struct RandomModelPlan {
  int inputs = 5;
  std::vector<int> lags{1, 3};
  int outputs = 4;
  int styles = 3;
  std::vector<int> states{3, 2};  // per label; each label is followed by the next
  unsigned seed = 1;
};

Eigen::MatrixXd random_covariance(int size, std::mt19937& random);
Model random_model(const RandomModelPlan& plan = {});

// State number `index` over all labels.
const State& state_of(const Model& model, int index);

Eigen::VectorXf random_vector(int size, unsigned seed, double deviation = 1);

// Which entries of x are there and real: `known` leading ones without those of missing values.
std::vector<int> entries_there(const Model& model, int known,
                               const std::vector<bool>& missing = {});

}  // namespace gait::testing
