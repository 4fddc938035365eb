#include "gait/model/model_field.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "gait/error.h"

namespace gait {

namespace {

// No side of an array can be longer; their products then fit into 64 bits.
constexpr int longest_side = 1 << 24;

double swapped_where_big_endian(double value) {
  if constexpr (std::endian::native == std::endian::big) {
    auto* bytes = reinterpret_cast<std::uint8_t*>(&value);
    std::reverse(bytes, bytes + sizeof value);
  }
  return value;
}

// Of each item what `get` makes of it.
template <typename Value, typename Get>
std::vector<Value> each(const ModelField& list, Get get) {
  std::vector<Value> values;
  for (const ModelField& item : list.items()) values.push_back((item.*get)());
  return values;
}

}  // namespace

void ModelField::fail(const std::string& what) const {
  throw Error((name_.empty() ? "" : name_ + ": ") + "expected " + what);
}

std::optional<ModelField> ModelField::find(const std::string& key) const {
  if (!value_->is_object()) fail("an object");
  const auto found = value_->find(key);
  if (found == value_->end() || found->is_null()) return std::nullopt;
  return ModelField(*document_, *found, name_.empty() ? key : name_ + '.' + key);
}

ModelField ModelField::operator[](const std::string& key) const {
  if (const auto field = find(key)) return *field;
  throw Error((name_.empty() ? key : name_ + '.' + key) + ": expected this field, found none");
}

std::vector<ModelField> ModelField::items() const {
  if (!value_->is_array()) fail("a list");
  std::vector<ModelField> items;
  items.reserve(value_->size());
  for (const nlohmann::json& item : *value_)
    items.push_back({*document_, item, name_ + '[' + std::to_string(items.size()) + ']'});
  return items;
}

double ModelField::number() const {
  if (!value_->is_number()) fail("a number");
  const double number = value_->get<double>();
  if (!std::isfinite(number)) fail("a finite number, found " + std::to_string(number));
  return number;
}

int ModelField::integer() const {
  constexpr int most = std::numeric_limits<int>::max();
  if (value_->is_number_unsigned() && value_->get<std::uint64_t>() <= std::uint64_t{most})
    return value_->get<int>();
  if (value_->is_number_integer() && !value_->is_number_unsigned() &&
      value_->get<std::int64_t>() >= -most)
    return value_->get<int>();
  fail("a whole number of at most nine digits");
}

bool ModelField::truth() const {
  if (!value_->is_boolean()) fail("true or false");
  return value_->get<bool>();
}

const std::string& ModelField::text() const {
  if (!value_->is_string()) fail("a text");
  return value_->get_ref<const std::string&>();
}

std::vector<double> ModelField::numbers() const { return each<double>(*this, &ModelField::number); }

std::vector<int> ModelField::integers() const { return each<int>(*this, &ModelField::integer); }

std::vector<Eigen::Index> ModelField::shape(std::size_t dimensions) const {
  const ModelField field = (*this)["shape"];
  std::vector<Eigen::Index> sides;
  for (const int side : field.integers()) {
    if (side < 0 || side > longest_side)
      field.fail("sides from 0 to " + std::to_string(longest_side) + ", found " +
                 std::to_string(side));
    sides.push_back(side);
  }
  if (sides.size() != dimensions)
    field.fail(std::to_string(dimensions) + " sides, found " + std::to_string(sides.size()));
  return sides;
}

std::span<const std::uint8_t> ModelField::data(Eigen::Index values) const {
  const ModelField field = (*this)["data"];
  if (!field.value_->is_binary()) field.fail("bytes");
  const auto bytes = document_->blob(*field.value_);
  const std::size_t wanted = static_cast<std::size_t>(values) * sizeof(double);
  if (bytes.size() != wanted)
    field.fail(std::to_string(wanted) + " bytes, as its shape says, found " +
               std::to_string(bytes.size()));
  return bytes;
}

Eigen::VectorXd ModelField::vector() const {
  const Eigen::Index size = shape(1)[0];
  const auto bytes = data(size);
  Eigen::VectorXd vector(size);
  copy_values(bytes.data(), {vector.data(), static_cast<std::size_t>(size)});
  return vector;
}

Eigen::MatrixXd ModelField::matrix() const {
  const std::vector<Eigen::Index> sides = shape(2);
  const auto bytes = data(sides[0] * sides[1]);
  Eigen::MatrixXd matrix(sides[0], sides[1]);
  copy_values(bytes.data(), {matrix.data(), static_cast<std::size_t>(matrix.size())});
  return matrix;
}

Eigen::MatrixXd ModelField::symmetric() const {
  const std::vector<Eigen::Index> sides = shape(2);
  const Eigen::Index size = sides[0];
  if (sides[1] != size)
    fail("as many columns as rows, found " + std::to_string(size) + " by " +
         std::to_string(sides[1]));
  const std::uint8_t* bytes = data(size * (size + 1) / 2).data();
  Eigen::MatrixXd matrix(size, size);
  for (Eigen::Index column = 0; column < size; ++column) {
    const auto rows = static_cast<std::size_t>(size - column);
    copy_values(bytes, {&matrix(column, column), rows});
    bytes += rows * sizeof(double);
  }
  matrix.triangularView<Eigen::StrictlyUpper>() = matrix.transpose();
  return matrix;
}

void copy_values(const std::uint8_t* bytes, std::span<double> values) {
  if (values.empty()) return;
  std::memcpy(values.data(), bytes, values.size_bytes());
  for (double& value : values) value = swapped_where_big_endian(value);
}

void copy_values(std::span<const double> values, std::uint8_t* bytes) {
  for (const double value : values) {
    const double little = swapped_where_big_endian(value);
    std::memcpy(bytes, &little, sizeof little);
    bytes += sizeof little;
  }
}

}  // namespace gait
