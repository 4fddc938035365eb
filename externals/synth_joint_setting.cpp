#include "synth_joint_setting.h"

#include <algorithm>

#include "gait/error.h"
#include "gait/model/stream_layout.h"
#include "pd/named_argument.h"

namespace gait::pd {

namespace {

constexpr double most = 1000;

// The stream, of all of a model's, that turns the joint that argument 0 names. A model of plain
// streams has no joints: the argument then names a stream. Throws Error when there is none.
int stream_of_joint(const Arguments& arguments, const Model& model) {
  if (!model.body) {
    std::vector<Stream> streams = model.inputs;
    streams.insert(streams.end(), model.outputs.begin(), model.outputs.end());
    return named_argument(arguments, 0, streams, "joint");
  }
  const std::vector<Joint>& joints = model.body->skeleton.joints;
  const int joint = named_argument(arguments, 0, joints, "joint");
  if (const int stream = StreamLayout::of_all(model).stream_of(joint); stream >= 0) return stream;
  arguments.fail("joint '" + joints[static_cast<std::size_t>(joint)].name +
                 "' is neither input nor output of " + model.name);
}

// Throws Error for what is wrong whatever the model.
void check(const Arguments& arguments) {
  if (arguments.size() < 2) arguments.fail("expected a joint, then scale, shift, fix or free");
  arguments.text(0);
  const std::string what = arguments.symbol(1);
  if (what == "free") {
    arguments.expect_count(2);
  } else if (what == "scale") {
    arguments.expect_count(3);
    arguments.number(2, -10, 10);
  } else if (what == "shift" || what == "fix") {
    if (arguments.size() < 3) arguments.fail("expected one number per value of the joint");
    for (int i = 2; i < arguments.size(); ++i) arguments.number(i, -most, most);
  } else {
    arguments.fail_at(1, "scale, shift, fix or free");
  }
}

}  // namespace

void JointSetting::set(const Arguments& arguments, Synthesiser& synthesiser) {
  const int stream = stream_of_joint(arguments, synthesiser.model());
  const std::string what = arguments.symbol(1);
  if (what == "free") {
    synthesiser.free(stream);
  } else if (what == "scale") {
    synthesiser.set_scale(stream, static_cast<float>(arguments.number(2)));
  } else {
    const int size = StreamLayout::of_all(synthesiser.model())[stream].size;
    if (arguments.size() != 2 + size)
      arguments.fail("expected " + std::to_string(size) + " numbers after " + what + ", got " +
                     std::to_string(arguments.size() - 2));
    std::vector<float> values;
    for (int i = 0; i < size; ++i) values.push_back(static_cast<float>(arguments.number(2 + i)));
    if (what == "shift")
      synthesiser.set_shift(stream, values);
    else
      synthesiser.fix(stream, values);
  }
}

void JointSetting::take(const Arguments& arguments, Synthesiser* synthesiser) {
  check(arguments);
  if (synthesiser) set(arguments, *synthesiser);
  const std::string joint = arguments.text(0), what = arguments.symbol(1);
  if (what == "free")
    std::erase_if(said_, [&](const auto& entry) { return entry.first.first == joint; });
  else
    said_[{joint, what}].assign(arguments.atoms().begin(), arguments.atoms().end());
}

void JointSetting::apply(Synthesiser& synthesiser,
                         const std::function<void(const std::string&)>& failed) {
  std::erase_if(said_, [&](const auto& entry) {
    const Message& message = entry.second;
    try {
      set(Arguments(object_, "joint", static_cast<int>(message.size()), message.data()),
          synthesiser);
      return false;
    } catch (const Error& error) {
      failed(error.what());
      return true;
    }
  });
}

void JointSetting::dump(Outlet& info) const {
  for (const auto& [key, message] : said_) info.add(std::span(message)).send("joint");
}

}  // namespace gait::pd
