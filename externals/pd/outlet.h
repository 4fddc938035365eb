// Messages out. Every one begins with a selector; its atoms are gathered in a buffer of the outlet,
// which grows once and then is used again: nothing allocates at frame rate.
#pragma once

#include <m_pd.h>

#include <span>
#include <string>
#include <vector>

#include "pd/box.h"

namespace gait::pd {

class Outlet {
 public:
  // A message outlet. Outlets stand in the order they are made, left to right.
  explicit Outlet(Box& box) : outlet_(outlet_new(&box.object, nullptr)) {}

  // Room for messages of so many atoms, so that none has to be made at frame rate.
  void reserve(int atoms) {
    atoms_.reserve(static_cast<std::size_t>(atoms));
    sending_.reserve(static_cast<std::size_t>(atoms));
  }
  Outlet& add(double number);
  Outlet& add(int number) { return add(static_cast<double>(number)); }
  Outlet& add(float number) { return add(static_cast<double>(number)); }
  Outlet& add(std::span<const float> numbers);
  Outlet& add(const char* symbol);
  Outlet& add(const std::string& symbol) { return add(symbol.c_str()); }
  // Labels may be numbers: `12` goes out as a number.
  Outlet& add_text(const std::string& text);
  // What has come, as it was.
  Outlet& add(std::span<const t_atom> atoms);

  // Sends the atoms added since the last time. The buffer is empty before any object receives them,
  // so that a cord back to the same box does no harm.
  void send(const char* selector);
  void bang() { outlet_bang(outlet_); }

 private:
  t_outlet* outlet_;
  std::vector<t_atom> atoms_, sending_;
  bool busy_ = false;
};

}  // namespace gait::pd
