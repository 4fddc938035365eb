// The arguments of a message or of a box, checked as they are read. An argument that does not fit
// throws Error in one form: `gait.map: strength: expected a number, got 'loud'`.
#pragma once

#include <m_pd.h>

#include <span>
#include <string>
#include <string_view>

namespace gait::pd {

class Arguments {
 public:
  // `selector`: of the message; empty for a box's own arguments.
  Arguments(const char* object, const char* selector, int count, const t_atom* atoms)
      : object_(object), selector_(selector), atoms_(atoms, static_cast<std::size_t>(count)) {}

  std::string_view selector() const { return selector_; }
  int size() const { return static_cast<int>(atoms_.size()); }
  std::span<const t_atom> atoms() const { return atoms_; }

  bool is_number(int i) const { return i < size() && atoms_[i].a_type == A_FLOAT; }
  bool is_symbol(int i) const { return i < size() && atoms_[i].a_type == A_SYMBOL; }
  // A box's argument such as `-poly`.
  bool is_flag(int i) const { return is_symbol(i) && *atoms_[i].a_w.w_symbol->s_name == '-'; }
  // Whether argument `i` is there and no flag.
  bool is_word(int i) const { return i < size() && !is_flag(i); }

  double number(int i) const;                             // finite
  double number(int i, double least, double most) const;  // within
  int integer(int i, int least, int most) const;
  bool flag(int i) const;           // 0 or 1
  std::string symbol(int i) const;  // a symbol
  std::string text(int i) const;    // a symbol, or a number as it is written: labels may be either
  void expect_count(int count) const;
  // These arguments, which must be one: only().number(0).
  const Arguments& only() const {
    expect_count(1);
    return *this;
  }
  void expect_count(int least, int most) const;

  // Frames: whether these are exactly values.size() numbers; then they are copied. Never throws.
  bool read(std::span<float> values, int first = 0) const noexcept;

  [[noreturn]] void fail(const std::string& expected) const;  // "expected ..., got ..."
  [[noreturn]] void fail_at(int i, const std::string& expected) const;

 private:
  const char* object_;
  const char* selector_;
  std::span<const t_atom> atoms_;
};

// A number as Pd would write it.
std::string number_text(double value);

}  // namespace gait::pd
