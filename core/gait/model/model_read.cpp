#include <cmath>

#include "gait/error.h"
#include "gait/model/model_field.h"
#include "gait/model/model_fields.h"
#include "gait/model/model_file.h"
#include "gait/model/model_words.h"
#include "gait/names.h"
#include "gait/platform/path_text.h"
#include "gait/platform/whole_file.h"

namespace gait {

namespace {

// Models are some megabytes. A film that was named by mistake is refused before it is read.

template <typename Words>
auto kind_of(const Words& words, const ModelField& field) {
  std::string known;
  for (const auto& [kind, word] : words) {
    if (field.text() == word) return kind;
    append_name(known, word);
  }
  field.fail("one of " + known + ", found '" + field.text() + "'");
}

std::vector<double> values(const ModelField& field, std::size_t count) {
  std::vector<double> values = field.numbers();
  if (values.size() != count)
    field.fail(std::to_string(count) + " numbers, found " + std::to_string(values.size()));
  return values;
}

// Sets values to what one object of the file holds under their keys. Throws Error naming the field
// that is missing or of another kind.
class FieldReader {
 public:
  explicit FieldReader(const ModelField& object) : object_(object) {}

  // `context`: what the fields of the value depend on.
  template <typename Value, typename... Context>
  void operator()(const char* key, Value& value, const Context&... context) const {
    read(object_[key], value, context...);
  }

  template <typename Value>
  void optional(const char* key, Value& value, bool) const {
    if (const auto field = object_.find(key)) read(*field, value);
  }

  void symmetric(const char* key, Eigen::MatrixXd& matrix) const {
    matrix = object_[key].symmetric();
  }

  // Checked before what follows: times cannot become frames without it.
  void frame_rate(const char* key, double& rate) const {
    const ModelField field = object_[key];
    rate = field.number();
    if (rate < slowest_frame_rate || rate > fastest_frame_rate)
      field.fail("1 to 1000 frames per second, found " + std::to_string(rate));
  }

  // Seconds back to frames back; they are whole up to rounding.
  void lags(const char* key, std::vector<int>& lags, double frame_rate) const {
    for (const ModelField& item : object_[key].items()) {
      const double frames = item.number() * frame_rate;
      if (!(frames > 0.5 && frames < 1e6) || std::abs(frames - std::round(frames)) > 1e-6)
        item.fail("a time of whole frames, found " + std::to_string(frames));
      lags.push_back(static_cast<int>(std::lround(frames)));
    }
  }

  void joints(const char* key, Hinge& hinge) const {
    const ModelField field = object_[key];
    const std::vector<int> joints = field.integers();
    if (joints.size() != 3) field.fail("3 joints, found " + std::to_string(joints.size()));
    hinge.above = joints[0], hinge.joint = joints[1], hinge.below = joints[2];
  }

  void joints(const char* key, Body& body) const {
    std::vector<BodyJoint> joints;
    (*this)(key, joints);
    for (BodyJoint& item : joints) {
      body.skeleton.joints.push_back(std::move(item.joint));
      body.roles.push_back(item.role);
      body.references.push_back(item.reference);
    }
  }

 private:
  static void read(const ModelField& field, double& value) { value = field.number(); }
  static void read(const ModelField& field, int& value) { value = field.integer(); }
  static void read(const ModelField& field, bool& value) { value = field.truth(); }
  static void read(const ModelField& field, std::string& value) { value = field.text(); }
  static void read(const ModelField& field, Eigen::VectorXd& value) { value = field.vector(); }
  static void read(const ModelField& field, Eigen::MatrixXd& value) { value = field.matrix(); }
  static void read(const ModelField& field, StreamKind& value) {
    value = kind_of(stream_kind_words, field);
  }
  static void read(const ModelField& field, DecoderKind& value) {
    value = kind_of(decoder_kind_words, field);
  }
  static void read(const ModelField& field, Role& value) {
    const auto role = role_from_name(field.text());
    if (!role) field.fail("a joint's role, found '" + field.text() + "'");
    value = *role;
  }
  static void read(const ModelField& field, Eigen::Vector3d& value) {
    const std::vector<double> xyz = values(field, 3);
    value = {xyz[0], xyz[1], xyz[2]};
  }
  static void read(const ModelField& field, Eigen::Quaterniond& value) {
    const std::vector<double> wxyz = values(field, 4);
    value = {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
  }
  template <typename Value>
  static void read(const ModelField& field, std::optional<Value>& value) {
    read(field, value.emplace());
  }
  template <typename Value, typename... Context>
  static void read(const ModelField& field, std::vector<Value>& list, const Context&... context) {
    for (const ModelField& item : field.items()) read(item, list.emplace_back(), context...);
  }
  template <typename Part, typename... Context>
  static void read(const ModelField& field, Part& part, const Context&... context) {
    const FieldReader reader(field);
    fields_of(reader, part, context...);
  }

  const ModelField& object_;
};

void expect_format(const ModelField& document) {
  if (const auto format = document.find("format"); !format || format->text() != model_file_format)
    document.fail("a gait model; the format is another");
  const ModelField version = document["version"];
  if (version.integer() < 1) version.fail("1 or more, found " + std::to_string(version.integer()));
  if (version.integer() > model_file_version)
    version.fail("at most " + std::to_string(model_file_version) + ", found " +
                 std::to_string(version.integer()) + ": the model was made by a newer gait");
}

}  // namespace

Model parse_model(std::span<const std::uint8_t> bytes, const std::string& name) {
  try {
    const CborDocument document = read_cbor(bytes);
    const ModelField root(document);
    expect_format(root);
    Model model;
    const FieldReader reader(root);
    fields_of(reader, model);
    check_model(model);
    return model;
  } catch (const Error& error) {
    throw Error(name + ": " + error.what());
  }
}

Model read_model(const std::filesystem::path& path) {
  const std::string bytes = read_whole_file(path, "a model file");
  return parse_model({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                     utf8_of(path));
}

}  // namespace gait
