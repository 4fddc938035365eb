// A field of a model file while it is read: a value of the tree that knows its name, so that
// whatever is wrong with it can be said.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "gait/model/cbor_document.h"

namespace gait {

class ModelField {
 public:
  // The whole document, which must live as long as its fields.
  explicit ModelField(const CborDocument& document) : ModelField(document, document.tree, "") {}

  const std::string& name() const { return name_; }
  // Throws Error: "NAME: expected WHAT".
  [[noreturn]] void fail(const std::string& what) const;

  // All that follow throw Error when the value is of another kind.
  ModelField operator[](const std::string& key) const;           // missing: Error
  std::optional<ModelField> find(const std::string& key) const;  // missing or null: none
  std::vector<ModelField> items() const;                         // of a list

  double number() const;  // finite
  int integer() const;
  bool truth() const;
  const std::string& text() const;
  std::vector<double> numbers() const;
  std::vector<int> integers() const;

  // Arrays of float64 {"shape": [...], "data": bytes}, the first index fastest. `symmetric` takes
  // the lower triangle, column after column. Their size is what the file really holds.
  Eigen::VectorXd vector() const;
  Eigen::MatrixXd matrix() const;
  Eigen::MatrixXd symmetric() const;

 private:
  ModelField(const CborDocument& document, const nlohmann::json& value, std::string name)
      : document_(&document), value_(&value), name_(std::move(name)) {}

  std::vector<Eigen::Index> shape(std::size_t dimensions) const;
  std::span<const std::uint8_t> data(Eigen::Index values) const;

  const CborDocument* document_;
  const nlohmann::json* value_;
  std::string name_;
};

// Copies float64 values from or to their little-endian bytes.
void copy_values(const std::uint8_t* bytes, std::span<double> values);
void copy_values(std::span<const double> values, std::uint8_t* bytes);

}  // namespace gait
