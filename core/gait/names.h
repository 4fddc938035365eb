// Names in a row, as messages list them: "right, left".
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace gait {

// Appends a name to a row of them, after a comma unless it is the first.
inline void append_name(std::string& row, std::string_view name) {
  if (!row.empty()) row += ", ";
  row += name;
}

// All names in a row. `name_of`: what to call an element, or its member that is its name; without
// it elements are names themselves.
template <typename Range, typename NameOf = std::identity>
std::string joined_names(const Range& range, NameOf name_of = {}) {
  std::string row;
  for (const auto& element : range) append_name(row, std::invoke(name_of, element));
  return row;
}

}  // namespace gait
