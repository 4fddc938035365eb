// A pattern that reads style, subject and speed from a file's name: `walk_{style}_{take}.bvh`.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gait::tool {

// What a name says; what it does not say is empty.
struct NameFields {
  std::string style, subject;
  std::optional<double> speed;  // m/s
};

// Fields: {style} and {subject} take at least one character, {take} a whole number, {speed} a
// number, {*} anything or nothing. All else stands for itself. Where a name could be read in
// several ways, fields are as short as possible from left to right: `walk_{style}_{take}` reads
// walk_in_a_hurry_2 as in_a_hurry, as a take is a number.
class NamePattern {
 public:
  // Throws UsageError when a field is unknown, not closed or named twice, or when there is none.
  explicit NamePattern(std::string_view pattern);

  // `file_name` without folders; the ending .bvh may be left out of the pattern. Nothing when the
  // name does not fit.
  std::optional<NameFields> read(std::string_view file_name) const;

 private:
  enum class Field { text, style, subject, speed, take, any };
  struct Piece {
    Field field;
    std::string text;  // of Field::text
  };
  bool match(std::size_t piece, std::string_view rest, NameFields& fields) const;
  static bool takes(Field field, std::string_view text, NameFields& fields);

  std::vector<Piece> pieces_;
};

}  // namespace gait::tool
