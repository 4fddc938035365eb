#include "gait/files/bvh_cursor.h"

#include <algorithm>
#include <cmath>

#include "gait/numbers.h"

namespace gait {
namespace {

// Larger than any angle or place in a recording; squares of it still fit a double with ease.
constexpr double largest_number = 1e9;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }
bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_space(char c) { return is_blank(c) || is_line_end(c); }
bool is_brace(char c) { return c == '{' || c == '}'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string found(std::string_view word) {
  return word.empty() ? "the end of the file" : in_quotes(word);
}

}  // namespace

bool same_word(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (lower(a[i]) != lower(b[i])) return false;
  return true;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t most = 40;
  constexpr char digits[] = "0123456789abcdef";
  std::string result = "'";
  for (const char c : text.substr(0, most)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7f) {
      result += "\\x";
      result += digits[byte >> 4];
      result += digits[byte & 15];
    } else {
      result += c;
    }
  }
  if (text.size() > most) result += "...";
  return result + "'";
}

BvhCursor::BvhCursor(std::string_view text, std::string_view name) : text_(text), name_(name) {
  if (text_.starts_with("\xEF\xBB\xBF")) position_ = 3;
  // An old end-of-file mark and zero padding are not content.
  while (!text_.empty() && (text_.back() == '\x1a' || text_.back() == '\0')) text_.remove_suffix(1);
  position_ = std::min(position_, text_.size());
}

bool BvhCursor::skip_space() {
  while (position_ < text_.size() && is_space(text_[position_])) ++position_;
  return position_ < text_.size();
}

bool BvhCursor::skip_blanks() {
  while (position_ < text_.size() && is_blank(text_[position_])) ++position_;
  return position_ < text_.size() && !is_line_end(text_[position_]);
}

std::string_view BvhCursor::peek() {
  if (position_ < peeked_) return text_.substr(position_, peeked_ - position_);
  if (!skip_space()) return {};
  std::size_t end = position_;
  if (is_brace(text_[end])) return text_.substr(end, 1);
  while (end < text_.size() && !is_space(text_[end]) && !is_brace(text_[end])) ++end;
  peeked_ = end;
  return text_.substr(position_, end - position_);
}

std::string_view BvhCursor::word() {
  const std::string_view result = peek();
  position_ += result.size();
  return result;
}

bool BvhCursor::take(std::string_view expected) {
  const std::string_view next = peek();
  if (!same_word(next, expected)) return false;
  position_ += next.size();
  return true;
}

void BvhCursor::require(std::string_view expected, std::string_view why) {
  if (take(expected)) return;
  fail("expected '" + std::string(expected) + "' " + std::string(why) + ", found " + found(peek()));
}

void BvhCursor::require_title(std::string_view title) {
  const std::string expected = "expected '" + std::string(title) + ":', found ";
  for (std::string_view left = title; !left.empty();) {
    const std::size_t space = left.find(' ');
    const std::string_view wanted = left.substr(0, space);
    std::string_view next = peek();
    if (next.size() < wanted.size() || !same_word(next.substr(0, wanted.size()), wanted))
      fail(expected + found(next));
    position_ += wanted.size();
    left = space == std::string_view::npos ? std::string_view{} : left.substr(space + 1);
  }
  if (skip_blanks() && text_[position_] == ':') ++position_;
}

std::string_view BvhCursor::rest_of_line() {
  skip_blanks();
  std::size_t end = position_;
  while (end < text_.size() && !is_line_end(text_[end]) && !is_brace(text_[end])) ++end;
  std::string_view result = text_.substr(position_, end - position_);
  position_ = end;
  while (!result.empty() && is_blank(result.back())) result.remove_suffix(1);
  return result;
}

double BvhCursor::number(std::string_view what) {
  skip_space();
  double value = 0;
  if (numbers_in_line({&value, 1}) == 1) return value;
  const std::string_view next = peek();
  const bool plus = next.size() > 1 && next[0] == '+' && next[1] != '-';
  const std::string_view digits = next.substr(plus ? 1 : 0);
  if (digits.empty() || leading_number(digits).length != digits.size())
    fail("expected a number (" + std::string(what) + "), found " + found(next));
  fail("expected a finite number below 1e9 (" + std::string(what) + "), found " + found(next));
}

// Nearly all of a file is read here.
std::size_t BvhCursor::numbers_in_line(std::span<double> values) noexcept {
  const char* at = text_.data() + position_;
  const char* const end = text_.data() + text_.size();
  std::size_t count = 0;
  for (; count < values.size(); ++count) {
    while (at != end && is_blank(*at)) ++at;
    const char* begin = at;
    if (end - begin > 1 && *begin == '+' && begin[1] != '-') ++begin;
    const auto [value, length] = leading_number({begin, end});
    const char* const stop = begin + length;
    if (length == 0 || !(std::abs(value) <= largest_number) ||
        (stop != end && !is_space(*stop) && !is_brace(*stop)))
      break;
    values[count] = value;
    at = stop;
  }
  position_ = static_cast<std::size_t>(at - text_.data());
  return count;
}

bool BvhCursor::breaks_off() const {
  const std::string_view left = text_.substr(position_);
  const std::size_t word = left.find_first_not_of(" \t\f\v\r\n");
  return word == std::string_view::npos ||
         (left.size() - word < 32 &&
          left.find_first_not_of("+-.0123456789eE", word) == std::string_view::npos);
}

long long BvhCursor::count(std::string_view what, long long least, long long most) {
  const std::string_view next = peek();
  const auto value = whole_number_in<long long>(next);
  if (!value || *value < least || *value > most)
    fail("expected " + std::string(what) + ", a whole number from " + std::to_string(least) +
         " to " + std::to_string(most) + ", found " + found(next));
  position_ += next.size();
  return *value;
}

std::string BvhCursor::here(std::string_view message) const {
  // CR LF, LF and CR alone each end one line.
  int line = 1;
  for (std::size_t at = 0; at < position_; ++at)
    line += text_[at] == '\n' ||
            (text_[at] == '\r' && (at + 1 == text_.size() || text_[at + 1] != '\n'));
  return std::string(name_) + ":" + std::to_string(line) + ": " + std::string(message);
}

void BvhCursor::fail(std::string_view message) const { throw Error(here(message)); }

}  // namespace gait
