#include "pd/outlet.h"

#include <cstdlib>

namespace gait::pd {

Outlet& Outlet::add(double number) {
  t_atom atom;
  SETFLOAT(&atom, static_cast<t_float>(number));
  atoms_.push_back(atom);
  return *this;
}

Outlet& Outlet::add(std::span<const float> numbers) {
  for (const float number : numbers) add(static_cast<double>(number));
  return *this;
}

Outlet& Outlet::add(const char* symbol) {
  t_atom atom;
  SETSYMBOL(&atom, gensym(symbol));
  atoms_.push_back(atom);
  return *this;
}

Outlet& Outlet::add_text(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' ? add(number) : add(text);
}

Outlet& Outlet::add(std::span<const t_atom> atoms) {
  atoms_.insert(atoms_.end(), atoms.begin(), atoms.end());
  return *this;
}

void Outlet::send(const char* selector) {
  if (busy_) {  // a cord leads back here: rare, and then a copy is made
    std::vector<t_atom> again;
    again.swap(atoms_);
    outlet_anything(outlet_, gensym(selector), static_cast<int>(again.size()), again.data());
    return;
  }
  sending_.swap(atoms_);
  atoms_.clear();
  busy_ = true;
  outlet_anything(outlet_, gensym(selector), static_cast<int>(sending_.size()), sending_.data());
  busy_ = false;
}

}  // namespace gait::pd
