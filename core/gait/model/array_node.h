// Arrays of float64 as a model file holds them: {"shape": [...], "data": bytes}, the first index
// fastest; what ModelField::vector, matrix and symmetric read.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace gait {

nlohmann::json array_node(const Eigen::VectorXd& vector);
nlohmann::json array_node(const Eigen::MatrixXd& matrix);
// Of a symmetric matrix the lower triangle, column after column.
nlohmann::json symmetric_array_node(const Eigen::MatrixXd& matrix);

}  // namespace gait
