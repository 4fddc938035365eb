// Cursor in the text of a BVH file: reads words and numbers, and throws errors that name file and
// line. Private to reading BVH.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "gait/error.h"

namespace gait {

class BvhCursor {
 public:
  // `text` and `name` must outlive the cursor. A byte order mark is skipped.
  BvhCursor(std::string_view text, std::string_view name);

  std::size_t bytes_left() const { return text_.size() - position_; }

  // Moves over white space, ends of lines included. False at the end of the file.
  bool skip_space();
  // Moves over white space within the line. False at the end of the line or file.
  bool skip_blanks();
  // Moves over blank lines to the first thing on a line. False at the end of the file.
  bool next_line() { return skip_space(); }

  // The next word (up to white space or a brace; a brace is a word), without moving; empty at the
  // end of the file.
  std::string_view peek();
  std::string_view word();
  // Takes the next word if it is this one, upper or lower case alike.
  bool take(std::string_view expected);
  // Takes the next word; throws Error when it is not this one. `why`: the purpose of the word, for
  // the message.
  void require(std::string_view expected, std::string_view why);

  // Takes `Frames:` or `Frame Time:`; a space before the colon is allowed, and so is a missing
  // colon.
  void require_title(std::string_view title);

  // The rest of the line up to a brace, trimmed: names may hold spaces.
  std::string_view rest_of_line();

  // A finite number of sensible size. `what`: its meaning, for the message.
  double number(std::string_view what);
  // Such numbers from here on, as many as the line holds and `values` takes. Returns how many there
  // are; the cursor stands behind the last.
  std::size_t numbers_in_line(std::span<double> values) noexcept;
  // Whether the text ends here, but for white space, or within a number that began here.
  bool breaks_off() const;
  bool ends_with_a_line() const {
    return text_.empty() || text_.back() == '\n' || text_.back() == '\r';
  }
  // A whole number in [least, most].
  long long count(std::string_view what, long long least, long long most);

  [[noreturn]] void fail(std::string_view message) const;
  // "path:12: message"
  std::string here(std::string_view message) const;

 private:
  std::string_view text_;
  std::string_view name_;
  std::size_t position_ = 0;
  std::size_t peeked_ = 0;  // the end of the word at `position_`, when it has been looked for
};

// For messages: in quotes, at most 40 bytes, what cannot be printed as \xNN.
std::string in_quotes(std::string_view text);

// True when both are the same but for upper and lower case (ASCII).
bool same_word(std::string_view a, std::string_view b);

}  // namespace gait
