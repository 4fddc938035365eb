// Where the values of streams lie in a frame, and which joint of the body each of them turns.
#pragma once

#include <span>
#include <vector>

#include "gait/model/model.h"

namespace gait {

struct StreamPlace {
  int begin = 0, size = 0;  // of its values in a frame
  StreamKind kind = StreamKind::rotation;
  int joint = -1;  // of the body, that a rotation turns; -1: none

  bool turns() const noexcept { return kind == StreamKind::rotation; }
};

class StreamLayout {
 public:
  // `joints`: one per rotation stream, in their order; empty without a body.
  explicit StreamLayout(const std::vector<Stream>& streams, const std::vector<int>& joints = {});

  static StreamLayout of_inputs(const Model& model);
  static StreamLayout of_outputs(const Model& model);
  static StreamLayout of_all(const Model& model);  // inputs, then outputs
  static StreamLayout of_body(const Body& body);   // a whole pose: a rotation per joint

  int streams() const noexcept { return static_cast<int>(places_.size()); }
  int values() const noexcept { return values_; }  // of a frame
  int values(StreamKind kind) const noexcept;      // of its streams of this kind
  bool has(int stream) const noexcept { return stream >= 0 && stream < streams(); }
  const StreamPlace& operator[](int stream) const noexcept {
    return places_[static_cast<std::size_t>(stream)];
  }
  auto begin() const noexcept { return places_.begin(); }
  auto end() const noexcept { return places_.end(); }

  // The stream that turns a joint of the body; -1: none does.
  int stream_of(int joint) const noexcept;
  // A stream's values in a frame.
  std::span<const float> of(int stream, std::span<const float> frame) const noexcept {
    return frame.subspan(static_cast<std::size_t>((*this)[stream].begin),
                         static_cast<std::size_t>((*this)[stream].size));
  }
  // Whether these can be values of a stream: it exists, they are as many and finite.
  bool fits(int stream, std::span<const float> values) const noexcept;

 private:
  void add(const std::vector<Stream>& streams, const std::vector<int>& joints);

  std::vector<StreamPlace> places_;
  int values_ = 0;
};

}  // namespace gait
