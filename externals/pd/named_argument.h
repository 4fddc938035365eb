// An argument that names one of several things of a model (a joint, a stream, a label, a style): by
// its name, or by its number from 0 in the model's order.
#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <vector>

#include "gait/names.h"
#include "pd/arguments.h"

namespace gait::pd {

inline const std::string& name_of(const std::string& name) { return name; }
template <class Named>
const std::string& name_of(const Named& named) {
  return named.name;
}

// All names, with commas between them.
template <class Named>
std::string names_of(const std::vector<Named>& all) {
  return joined_names(all, [](const Named& one) { return name_of(one); });
}

// The index of the one of this name; -1 when there is none.
template <class Named>
int index_named(const std::vector<Named>& all, std::string_view name) noexcept {
  for (std::size_t i = 0; i < all.size(); ++i)
    if (name_of(all[i]) == name) return static_cast<int>(i);
  return -1;
}

// The index of the one that a text names, or gives the number of; -1 when there is none.
template <class Named>
int index_said(const std::vector<Named>& all, std::string_view text) noexcept {
  if (const int named = index_named(all, text); named >= 0) return named;
  int number = -1;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  const bool there = read.ptr == end && number >= 0 && number < static_cast<int>(all.size());
  return there ? number : -1;
}

// The index of the one that argument `i` names. Throws Error, which lists all names, when there is
// none; nothing allocates otherwise. `what`: the word for one of them, as "input".
template <class Named>
int named_argument(const Arguments& arguments, int i, const std::vector<Named>& all,
                   const std::string_view what) {
  if (arguments.is_number(i)) return arguments.integer(i, 0, static_cast<int>(all.size()) - 1);
  if (!arguments.is_symbol(i))
    arguments.fail_at(i, (what.find_first_of("aeiou") == 0 ? "an " : "a ") + std::string(what));
  const char* const name = arguments.atoms()[static_cast<std::size_t>(i)].a_w.w_symbol->s_name;
  if (const int at = index_named(all, name); at >= 0) return at;
  arguments.fail("no " + std::string(what) + " '" + name + "'; there are " + names_of(all));
}

}  // namespace gait::pd
