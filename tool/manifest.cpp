#include "manifest.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "gait/error.h"
#include "gait/numbers.h"
#include "gait/platform/path_text.h"
#include "gait/platform/whole_file.h"

namespace gait::tool {

namespace {

// Reads CSV (RFC 4180) row by row.
class CsvReader {
 public:
  CsvReader(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
  }

  int line() const { return line_; }  // of the row read last
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(name_ + ":" + std::to_string(line_) + ": " + what);
  }

  // The next row that is not empty; false at the end.
  bool next(std::vector<std::string>& row) {
    while (!text_.empty()) {
      line_ = next_line_;
      row.clear();
      do row.push_back(field());
      while (take(","));
      if (!take("\r\n") && !take("\n") && !take("\r") && !text_.empty())
        fail("expected a comma or the end of the line after a quoted field");
      ++next_line_;
      if (row.size() > 1 || !row.front().empty()) return true;
    }
    return false;
  }

 private:
  bool take(std::string_view what) {
    if (!text_.starts_with(what)) return false;
    text_.remove_prefix(what.size());
    return true;
  }

  std::string field() {
    if (take("\"")) return quoted();
    const std::size_t end = std::min(text_.find_first_of(",\r\n"), text_.size());
    std::string_view raw = text_.substr(0, end);
    text_.remove_prefix(end);
    const std::size_t begin = raw.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return "";
    raw = raw.substr(begin, raw.find_last_not_of(" \t") - begin + 1);
    return std::string(raw);
  }

  std::string quoted() {
    std::string value;
    while (!text_.empty()) {
      const char c = text_.front();
      text_.remove_prefix(1);
      if (c == '"' && !take("\"")) return value;
      next_line_ += c == '\n';
      value += c;
    }
    fail("expected a closing double quote");
  }

  std::string_view text_;
  std::string name_;
  int line_ = 1, next_line_ = 1;
};

double speed_of(const std::string& text, const CsvReader& reader) {
  const auto speed = number_in(text);
  if (!speed || *speed < 0) reader.fail("expected a speed in m/s, found '" + text + "'");
  return *speed;
}

}  // namespace

Manifest read_manifest(const std::filesystem::path& path) {
  const std::string text = read_whole_file(path, "a manifest");
  CsvReader reader(text, utf8_of(path));
  Manifest manifest;
  std::vector<std::string> columns, row;
  if (!reader.next(columns))
    reader.fail("expected a line `file,style,subject,speed`, found nothing");
  if (std::count(columns.begin(), columns.end(), "file") != 1)
    reader.fail("expected a line that names the columns, one of them `file`");
  for (const std::string& column : columns)
    if (column != "file" && column != "style" && column != "subject" && column != "speed")
      manifest.warnings.push_back(utf8_of(path) + ": column '" + column +
                                  "' is not used; known are file, style, subject and speed");

  std::set<std::filesystem::path> seen;
  while (reader.next(row)) {
    if (row.size() != columns.size())
      reader.fail("expected " + std::to_string(columns.size()) + " fields, found " +
                  std::to_string(row.size()));
    ManifestEntry entry;
    entry.line = reader.line();
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (row[i].empty()) continue;
      if (columns[i] == "file") entry.file = path.parent_path() / path_from_utf8(row[i]);
      if (columns[i] == "style") entry.fields.style = row[i];
      if (columns[i] == "subject") entry.fields.subject = row[i];
      if (columns[i] == "speed") entry.fields.speed = speed_of(row[i], reader);
    }
    if (entry.file.empty()) reader.fail("expected the name of a file");
    if (!seen.insert(entry.file.lexically_normal()).second)
      reader.fail("'" + utf8_of(entry.file) + "' is there twice");
    manifest.entries.push_back(std::move(entry));
  }
  return manifest;
}

}  // namespace gait::tool
