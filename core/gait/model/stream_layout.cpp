#include "gait/model/stream_layout.h"

#include <algorithm>
#include <numeric>

#include "gait/motion/finite.h"

namespace gait {

namespace {

std::vector<int> joints_of(const Model& model, std::vector<int> Body::*joints) {
  return model.body ? *model.body.*joints : std::vector<int>{};
}

}  // namespace

StreamLayout::StreamLayout(const std::vector<Stream>& streams, const std::vector<int>& joints) {
  add(streams, joints);
}

void StreamLayout::add(const std::vector<Stream>& streams, const std::vector<int>& joints) {
  auto joint = joints.begin();
  for (const Stream& stream : streams) {
    const bool turns = stream.kind == StreamKind::rotation && joint != joints.end();
    places_.push_back({values_, stream.size, stream.kind, turns ? *joint++ : -1});
    values_ += stream.size;
  }
}

StreamLayout StreamLayout::of_inputs(const Model& model) {
  return StreamLayout(model.inputs, joints_of(model, &Body::input_joints));
}

StreamLayout StreamLayout::of_outputs(const Model& model) {
  return StreamLayout(model.outputs, joints_of(model, &Body::output_joints));
}

StreamLayout StreamLayout::of_all(const Model& model) {
  StreamLayout all = of_inputs(model);
  all.add(model.outputs, joints_of(model, &Body::output_joints));
  return all;
}

StreamLayout StreamLayout::of_body(const Body& body) {
  std::vector<int> joints(body.skeleton.joints.size());
  std::iota(joints.begin(), joints.end(), 0);
  return StreamLayout(std::vector<Stream>(joints.size()), joints);
}

int StreamLayout::values(StreamKind kind) const noexcept {
  int values = 0;
  for (const StreamPlace& place : places_)
    if (place.kind == kind) values += place.size;
  return values;
}

int StreamLayout::stream_of(int joint) const noexcept {
  const auto found = std::ranges::find(places_, joint, &StreamPlace::joint);
  return joint < 0 || found == places_.end() ? -1 : static_cast<int>(found - places_.begin());
}

bool StreamLayout::fits(int stream, std::span<const float> values) const noexcept {
  return has(stream) && values.size() == static_cast<std::size_t>((*this)[stream].size) &&
         all_finite(values);
}

}  // namespace gait
