#include "pd/arguments.h"

#include <cmath>
#include <cstdio>

#include "gait/error.h"

namespace gait::pd {

namespace {

std::string written(const t_atom& atom) {
  if (atom.a_type == A_FLOAT) return number_text(atom.a_w.w_float);
  if (atom.a_type == A_SYMBOL) return std::string("'") + atom.a_w.w_symbol->s_name + "'";
  return "something else";
}

std::string times(int count) {
  return std::to_string(count) + (count == 1 ? " argument" : " arguments");
}

}  // namespace

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

void Arguments::fail(const std::string& expected) const {
  throw Error(std::string(object_) + ": " + (*selector_ ? std::string(selector_) + ": " : "") +
              expected);
}

void Arguments::fail_at(int i, const std::string& expected) const {
  fail("expected " + expected + ", got " + (i < size() ? written(atoms_[i]) : "nothing"));
}

double Arguments::number(int i) const {
  if (!is_number(i)) fail_at(i, "a number");
  const double value = atoms_[i].a_w.w_float;
  if (!std::isfinite(value)) fail_at(i, "a finite number");
  return value;
}

double Arguments::number(int i, double least, double most) const {
  const double value = number(i);
  if (value < least || value > most)
    fail_at(i, "a number from " + number_text(least) + " to " + number_text(most));
  return value;
}

int Arguments::integer(int i, int least, int most) const {
  const double value = number(i);
  if (value != std::floor(value) || value < least || value > most)
    fail_at(i, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int>(value);
}

bool Arguments::flag(int i) const {
  const double value = number(i);
  if (value != 0 && value != 1) fail_at(i, "0 or 1");
  return value == 1;
}

std::string Arguments::symbol(int i) const {
  if (!is_symbol(i)) fail_at(i, "a name");
  return atoms_[i].a_w.w_symbol->s_name;
}

std::string Arguments::text(int i) const {
  if (is_number(i)) return number_text(atoms_[i].a_w.w_float);
  return symbol(i);
}

void Arguments::expect_count(int count) const {
  if (size() != count) fail("expected " + times(count) + ", got " + std::to_string(size()));
}

void Arguments::expect_count(int least, int most) const {
  if (size() < least || size() > most)
    fail("expected " + std::to_string(least) + " to " + times(most) + ", got " +
         std::to_string(size()));
}

bool Arguments::read(std::span<float> values, int first) const noexcept {
  if (atoms_.size() != values.size() + static_cast<std::size_t>(first)) return false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const t_atom& atom = atoms_[i + static_cast<std::size_t>(first)];
    if (atom.a_type != A_FLOAT) return false;
    values[i] = static_cast<float>(atom.a_w.w_float);
  }
  return true;
}

}  // namespace gait::pd
