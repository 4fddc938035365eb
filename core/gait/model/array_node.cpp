#include "gait/model/array_node.h"

#include "gait/model/model_field.h"

namespace gait {

namespace {

using Json = nlohmann::json;

Json node_of(std::vector<Eigen::Index> shape, std::vector<std::uint8_t> bytes) {
  return {{"shape", std::move(shape)}, {"data", Json::binary(std::move(bytes), cbor_float64_tag)}};
}

}  // namespace

Json array_node(const Eigen::VectorXd& vector) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(vector.size()) * sizeof(double));
  copy_values({vector.data(), static_cast<std::size_t>(vector.size())}, bytes.data());
  return node_of({vector.size()}, std::move(bytes));
}

Json array_node(const Eigen::MatrixXd& matrix) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(matrix.size()) * sizeof(double));
  copy_values({matrix.data(), static_cast<std::size_t>(matrix.size())}, bytes.data());
  return node_of({matrix.rows(), matrix.cols()}, std::move(bytes));
}

Json symmetric_array_node(const Eigen::MatrixXd& matrix) {
  const Eigen::Index size = matrix.rows();
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size * (size + 1) / 2) * sizeof(double));
  std::uint8_t* at = bytes.data();
  for (Eigen::Index column = 0; column < size; ++column) {
    const auto rows = static_cast<std::size_t>(size - column);
    copy_values({&matrix(column, column), rows}, at);
    at += rows * sizeof(double);
  }
  return node_of({size, size}, std::move(bytes));
}

}  // namespace gait
