#include "viterbi_single_inputs.h"

#include <array>

#include "pd/named_argument.h"

namespace gait::pd {

namespace {

// The numbers of a message from the `first` argument on.
template <int count>
std::array<float, count> numbers(const Arguments& arguments, int first) {
  std::array<float, count> read;
  for (int i = 0; i < count; ++i)
    read[static_cast<std::size_t>(i)] = static_cast<float>(arguments.number(first + i));
  return read;
}

}  // namespace

void set_joint(const Arguments& arguments, const Model& model, InputStream& stream) {
  constexpr int most = 64;  // values of one plain stream
  const int input = named_argument(arguments, 0, model.inputs, "input");
  const int size = model.inputs[input].size;
  arguments.expect_count(1 + size);
  std::array<float, most> values;
  if (size > most) arguments.fail("expected an input of 64 values at most; send whole frames");
  for (int i = 0; i < size; ++i)
    values[static_cast<std::size_t>(i)] = static_cast<float>(arguments.number(1 + i));
  stream.set_values(input, std::span(values).first(static_cast<std::size_t>(size)));
}

void set_quaternion(const Arguments& arguments, const Model& model, InputStream& stream) {
  const int input = named_argument(arguments, 0, model.inputs, "input");
  arguments.expect_count(5);
  const auto [x, y, z, w] = numbers<4>(arguments, 1);
  if (!stream.set_rotation(input, Eigen::Quaternionf(w, x, y, z)))
    arguments.fail("expected an input that is a rotation, and a quaternion that is not 0");
}

void set_euler(const Arguments& arguments, const Model& model, InputStream& stream) {
  const int input = named_argument(arguments, 0, model.inputs, "input");
  arguments.expect_count(5);
  if (!stream.set_euler(input, arguments.symbol(1), numbers<3>(arguments, 2)))
    arguments.fail_at(1, "an order such as ZXY and an input that is a rotation");
}

}  // namespace gait::pd
