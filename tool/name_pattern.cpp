#include "name_pattern.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "commands.h"
#include "gait/numbers.h"

namespace gait::tool {

namespace {

constexpr std::string_view ending = ".bvh";

bool ends_with_bvh(std::string_view name) {
  return name.size() >= ending.size() &&
         std::equal(ending.begin(), ending.end(), name.end() - ending.size(),
                    [](char wanted, char found) {
                      return wanted == std::tolower(static_cast<unsigned char>(found));
                    });
}

}  // namespace

NamePattern::NamePattern(std::string_view pattern) {
  const std::map<std::string_view, Field> known{{"style", Field::style},
                                                {"subject", Field::subject},
                                                {"speed", Field::speed},
                                                {"take", Field::take},
                                                {"*", Field::any}};
  const std::string whole(pattern);
  if (ends_with_bvh(pattern)) pattern.remove_suffix(ending.size());
  while (!pattern.empty()) {
    const std::size_t brace = pattern.find('{');
    if (brace != 0) {
      pieces_.push_back({Field::text, std::string(pattern.substr(0, brace))});
      pattern.remove_prefix(std::min(brace, pattern.size()));
      continue;
    }
    const std::size_t close = pattern.find('}');
    if (close == std::string_view::npos)
      throw UsageError("--label '" + whole + "': expected } after {");
    const auto field = known.find(pattern.substr(1, close - 1));
    if (field == known.end())
      throw UsageError("--label '" + whole + "': no field '" +
                       std::string(pattern.substr(0, close + 1)) +
                       "'; there are {style}, {subject}, {speed}, {take} and {*}");
    if (field->second != Field::any &&
        std::any_of(pieces_.begin(), pieces_.end(),
                    [&](const Piece& piece) { return piece.field == field->second; }))
      throw UsageError("--label '" + whole + "': {" + std::string(field->first) +
                       "} is there twice");
    pieces_.push_back({field->second, ""});
    pattern.remove_prefix(close + 1);
  }
  if (std::none_of(pieces_.begin(), pieces_.end(), [](const Piece& piece) {
        return piece.field == Field::style || piece.field == Field::subject ||
               piece.field == Field::speed;
      }))
    throw UsageError("--label '" + whole +
                     "': expected {style}, {subject} or {speed}, it reads nothing from a name");
}

std::optional<NameFields> NamePattern::read(std::string_view file_name) const {
  if (ends_with_bvh(file_name)) file_name.remove_suffix(ending.size());
  NameFields fields;
  if (!match(0, file_name, fields)) return std::nullopt;
  return fields;
}

bool NamePattern::takes(Field field, std::string_view text, NameFields& fields) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  switch (field) {
    case Field::style:
      fields.style = text;
      return !text.empty();
    case Field::subject:
      fields.subject = text;
      return !text.empty();
    case Field::take:
      return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
    case Field::speed: {
      if (text.find_first_of("eE") != std::string_view::npos)
        return false;  // names have no exponents
      const auto speed = number_in(text);
      fields.speed = speed.value_or(0);
      return speed && *speed >= 0;
    }
    default:
      return true;
  }
}

bool NamePattern::match(std::size_t piece, std::string_view rest, NameFields& fields) const {
  if (piece == pieces_.size()) return rest.empty();
  const Piece& now = pieces_[piece];
  if (now.field == Field::text)
    return rest.starts_with(now.text) && match(piece + 1, rest.substr(now.text.size()), fields);
  if (piece + 1 == pieces_.size()) return takes(now.field, rest, fields);
  for (std::size_t length = 0; length <= rest.size(); ++length)
    if (takes(now.field, rest.substr(0, length), fields) &&
        match(piece + 1, rest.substr(length), fields)) {
      // A later, failed attempt must not have the last word.
      takes(now.field, rest.substr(0, length), fields);
      return true;
    }
  return false;
}

}  // namespace gait::tool
