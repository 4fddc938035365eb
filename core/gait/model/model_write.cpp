#include <nlohmann/json.hpp>

#include "gait/error.h"
#include "gait/model/model_field.h"
#include "gait/model/model_fields.h"
#include "gait/model/model_file.h"
#include "gait/model/model_words.h"
#include "gait/platform/whole_file.h"

namespace gait {

namespace {

using Json = nlohmann::json;

// An array of float64: {"shape": [...], "data": bytes}, as ModelField::vector reads it.
Json array_of(std::vector<Eigen::Index> shape, std::vector<std::uint8_t> bytes) {
  return {{"shape", std::move(shape)}, {"data", Json::binary(std::move(bytes), cbor_float64_tag)}};
}

std::vector<std::uint8_t> bytes_of(const double* values, Eigen::Index count) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(count) * sizeof(double));
  copy_values({values, static_cast<std::size_t>(count)}, bytes.data());
  return bytes;
}

// Keeps values under their keys in one object of the file.
class FieldWriter {
 public:
  template <typename Value, typename... Context>
  void operator()(const char* key, const Value& value, const Context&... context) {
    object_[key] = node(value, context...);
  }

  template <typename Value>
  void optional(const char* key, const Value& value, bool is_written) {
    if (is_written) object_[key] = node(value);
  }

  // The lower triangle, column after column.
  void symmetric(const char* key, const Eigen::MatrixXd& matrix) {
    const Eigen::Index size = matrix.rows();
    std::vector<double> triangle;
    for (Eigen::Index column = 0; column < size; ++column)
      triangle.insert(triangle.end(), matrix.col(column).begin() + column,
                      matrix.col(column).end());
    object_[key] = array_of({size, size}, bytes_of(triangle.data(), std::ssize(triangle)));
  }

  void frame_rate(const char* key, double rate) { object_[key] = rate; }

  // Times, so that the file does not depend on the frame rate.
  void lags(const char* key, const std::vector<int>& lags, double frame_rate) {
    std::vector<double> history;
    for (const int lag : lags) history.push_back(lag / frame_rate);
    object_[key] = history;
  }

  void joints(const char* key, const Hinge& hinge) {
    object_[key] = {hinge.above, hinge.joint, hinge.below};
  }

  void joints(const char* key, const Body& body) {
    std::vector<BodyJoint> joints;
    for (std::size_t i = 0; i < body.roles.size(); ++i)
      joints.push_back({body.skeleton.joints[i], body.roles[i], body.references[i]});
    (*this)(key, joints);
  }

  Json object() && { return std::move(object_); }

 private:
  static Json node(double value) { return value; }
  static Json node(int value) { return value; }
  static Json node(bool value) { return value; }
  static Json node(const std::string& value) { return value; }
  static Json node(StreamKind kind) { return word_of(stream_kind_words, kind); }
  static Json node(DecoderKind kind) { return word_of(decoder_kind_words, kind); }
  static Json node(Role role) { return role_name(role); }
  static Json node(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
  static Json node(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }
  static Json node(const Eigen::VectorXd& vector) {
    return array_of({vector.size()}, bytes_of(vector.data(), vector.size()));
  }
  static Json node(const Eigen::MatrixXd& matrix) {
    return array_of({matrix.rows(), matrix.cols()}, bytes_of(matrix.data(), matrix.size()));
  }
  template <typename Value>
  static Json node(const std::optional<Value>& value) {
    return node(*value);
  }
  template <typename Value, typename... Context>
  static Json node(const std::vector<Value>& list, const Context&... context) {
    Json items = Json::array();
    for (const Value& item : list) items.push_back(node(item, context...));
    return items;
  }
  template <typename Part, typename... Context>
  static Json node(const Part& part, const Context&... context) {
    FieldWriter writer;
    fields_of(writer, part, context...);
    return std::move(writer).object();
  }

  Json object_;
};

}  // namespace

std::vector<std::uint8_t> model_bytes(const Model& model) {
  check_model(model);
  FieldWriter writer;
  writer("format", std::string(model_file_format));
  writer("version", model_file_version);
  fields_of(writer, model);
  return Json::to_cbor(std::move(writer).object());
}

void write_model(const Model& model, const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = model_bytes(model);
  write_whole_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace gait
