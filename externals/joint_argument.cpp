#include "joint_argument.h"

#include <algorithm>
#include <vector>

#include "gait/model/stream_layout.h"
#include "gait/names.h"

namespace gait::pd {

namespace {

int find(const std::vector<std::string>& names, const Arguments& arguments, int i) {
  if (arguments.is_number(i)) return arguments.integer(i, 0, static_cast<int>(names.size()) - 1);
  const std::string wanted = arguments.symbol(i);
  const auto at = std::ranges::find(names, wanted);
  if (at != names.end()) return static_cast<int>(at - names.begin());
  arguments.fail("no joint '" + wanted + "'; there are " + joined_names(names));
}

}  // namespace

int joint_index(const Model& model, const Arguments& arguments, int i) {
  std::vector<std::string> names;
  for (const Joint& joint : model.body->skeleton.joints) names.push_back(joint.name);
  return find(names, arguments, i);
}

const Stream& stream_at(const Model& model, int stream) {
  const auto inputs = static_cast<int>(model.inputs.size());
  return stream < inputs ? model.inputs[static_cast<std::size_t>(stream)]
                         : model.outputs[static_cast<std::size_t>(stream - inputs)];
}

int joint_stream(const Model& model, const Arguments& arguments, int i) {
  if (!model.body) {
    std::vector<std::string> names;
    for (const auto* streams : {&model.inputs, &model.outputs})
      for (const Stream& stream : *streams) names.push_back(stream.name);
    return find(names, arguments, i);
  }
  const int joint = joint_index(model, arguments, i);
  if (const int stream = StreamLayout::of_all(model).stream_of(joint); stream >= 0) return stream;
  arguments.fail("joint '" + model.body->skeleton.joints[static_cast<std::size_t>(joint)].name +
                 "' is neither input nor output of " + model.name);
}

}  // namespace gait::pd
