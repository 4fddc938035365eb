#include "gait/files/label_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "gait/error.h"
#include "gait/numbers.h"
#include "gait/platform/path_text.h"
#include "gait/platform/whole_file.h"

namespace gait {
namespace {

constexpr double ticks_per_second = 1e7;  // HTK's 100 ns
constexpr double longest_time = 1e8;      // three years, in seconds: more is a damaged file
constexpr double most_labelled_frames = 1e9;

bool separates(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && separates(text.front())) text.remove_prefix(1);
  while (!text.empty() && separates(text.back())) text.remove_suffix(1);
  return text;
}

// Takes the part before the next separator off the line.
std::string_view take_field(std::string_view& line) {
  line = trimmed(line);
  const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
  const std::string_view field = line.substr(0, end);
  line.remove_prefix(end);
  return field;
}

class LineReader {
 public:
  LineReader(const std::string& name, int number) : name_(name), number_(number) {}

  LabelSegment segment(std::string_view line, std::optional<LabelForm>& form) const {
    const std::string_view whole = line;
    const std::string_view start = take_field(line);
    const bool tab = !line.empty() && line.front() == '\t';
    const std::string_view end = take_field(line);
    if (line.empty()) fail("'start end label'", whole);

    const bool ticks =
        !tab && whole_number_in<std::int64_t>(start) && whole_number_in<std::int64_t>(end);
    const LabelForm here = ticks ? LabelForm::htk : LabelForm::audacity;
    if (form && *form != here)
      fail(*form == LabelForm::htk ? "whole numbers of 100 ns as in the lines before (HTK)"
                                   : "seconds and tabs as in the lines before (Audacity)",
           whole);
    form = here;

    LabelSegment segment;
    segment.start = time(start, here);
    segment.end = time(end, here);
    if (segment.end < segment.start) fail("an end that is not before its start", whole);
    segment.label = here == LabelForm::htk ? take_field(line) : trimmed(line);
    if (segment.label.empty()) fail("a label after start and end", whole);
    return segment;
  }

 private:
  double time(std::string_view text, LabelForm form) const {
    double seconds = 0;
    if (form == LabelForm::htk) {
      seconds = static_cast<double>(*whole_number_in<std::int64_t>(text)) / ticks_per_second;
    } else {
      const LeadingNumber number = leading_number(text);
      if (text.empty() || number.length != text.size()) fail("a time in seconds", text);
      seconds = number.value;
    }
    if (!(seconds >= 0 && seconds <= longest_time)) fail("a finite time from 0 on", text);
    return seconds;
  }

  [[noreturn]] void fail(std::string_view expected, std::string_view found) const {
    std::string shown;
    for (const char c : found.substr(0, 60))
      shown += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    throw Error(name_ + ":" + std::to_string(number_) + ": expected " + std::string(expected) +
                ", found '" + shown + "'");
  }

  const std::string& name_;
  int number_;
};

void append_seconds(std::string& text, double seconds) {
  std::array<char, 64> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), seconds,
                                 std::chars_format::fixed, 6);
  text.append(digits.data(), end.ptr);
}

std::optional<Foot> foot_named(std::string_view label) {
  std::string name;
  for (const char c : label) name += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (name == "right" || name == "r") return Foot::right;
  if (name == "left" || name == "l") return Foot::left;
  return std::nullopt;
}

}  // namespace

LabelFile parse_labels(std::string_view text, const std::string& name) {
  LabelFile file;
  std::optional<LabelForm> form;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    if (line.empty() || line.front() == '\\') continue;
    file.segments.push_back(LineReader(name, number).segment(line, form));
  }
  if (form) file.form = *form;
  return file;
}

LabelFile read_labels(const std::filesystem::path& path) {
  return parse_labels(read_whole_file(path, "a label file"), utf8_of(path));
}

std::string labels_text(const std::vector<LabelSegment>& segments, LabelForm form) {
  const bool htk = form == LabelForm::htk;
  std::string text;
  for (const LabelSegment& segment : segments) {
    if (trimmed(segment.label) != segment.label || segment.label.empty() ||
        segment.label.find_first_of(htk ? " \t\r\n" : "\t\r\n") != std::string::npos)
      throw Error("expected a label that " + std::string(htk ? "HTK's" : "Audacity's") +
                  " form can hold, found '" + segment.label + "'");
    if (!(segment.start >= 0 && segment.end >= segment.start && segment.end <= longest_time))
      throw Error("expected a label's times from 0 on, the end not before the start, found " +
                  std::to_string(segment.start) + " to " + std::to_string(segment.end) + " s");
    if (htk) {
      text += std::to_string(std::llround(segment.start * ticks_per_second)) + ' ' +
              std::to_string(std::llround(segment.end * ticks_per_second)) + ' ';
    } else {
      append_seconds(text, segment.start);
      text += '\t';
      append_seconds(text, segment.end);
      text += '\t';
    }
    text += segment.label + '\n';
  }
  return text;
}

void write_labels(const std::vector<LabelSegment>& segments, LabelForm form,
                  const std::filesystem::path& path) {
  write_whole_file(path, labels_text(segments, form));
}

std::vector<LabelSegment> labels_from_contacts(const std::vector<Contact>& contacts,
                                               double frame_rate) {
  std::vector<LabelSegment> segments;
  for (const Step& step : steps_between(contacts))
    segments.push_back(
        {step.begin / frame_rate, step.end / frame_rate, std::string(foot_name(step.foot))});
  return segments;
}

std::vector<LabelSegment> labels_from(std::vector<LabelSegment> segments, double start) {
  std::erase_if(segments, [&](const LabelSegment& segment) { return segment.end <= start; });
  for (LabelSegment& segment : segments) {
    segment.start = std::max(0.0, segment.start - start);
    segment.end -= start;
  }
  return segments;
}

std::vector<Contact> contacts_from_labels(std::vector<LabelSegment> segments, double frame_rate) {
  std::ranges::stable_sort(segments, {}, &LabelSegment::start);
  std::vector<Contact> contacts;
  bool follows = false;  // the last contact is the end of a step, and may start the next
  for (const LabelSegment& segment : segments) {
    const std::optional<Foot> foot = foot_named(segment.label);
    if (!foot) continue;
    const std::string where =
        " in the step '" + segment.label + "' at " + std::to_string(segment.start) + " s";
    if (!(segment.end * frame_rate < most_labelled_frames))
      throw Error("expected fewer than 1e9 frames" + where + ", found more");
    const int begin = static_cast<int>(std::lround(segment.start * frame_rate));
    const int end = static_cast<int>(std::lround(segment.end * frame_rate));
    if (end <= begin) throw Error("expected at least one frame" + where + ", found none");
    if (follows && begin < contacts.back().frame)
      throw Error("expected steps one after the other, found an overlap" + where);
    if (follows && begin == contacts.back().frame) {
      if (contacts.back().foot != *foot)
        throw Error("expected right and left steps in turn, found one foot twice" + where);
    } else {
      contacts.push_back({begin, *foot});
    }
    contacts.push_back({end, other(*foot)});
    follows = true;
  }
  return contacts;
}

}  // namespace gait
