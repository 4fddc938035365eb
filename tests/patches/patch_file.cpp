#include "patches/patch_file.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "gait/error.h"

namespace gait::testing {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr int character = 7, line = 15;

// Statements end with a semicolon; one with a backslash before it belongs to a message.
std::vector<Words> statements(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw Error(file.string() + ": cannot be read");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::vector<Words> all;
  std::string one;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != ';' || (i > 0 && text[i - 1] == '\\')) {
      one += text[i];
      continue;
    }
    std::istringstream words(one);
    all.emplace_back(std::istream_iterator<std::string>(words),
                     std::istream_iterator<std::string>());
    one.clear();
  }
  return all;
}

struct Lines {
  int count = 1, longest = 0;
};

// As Pd breaks them: after `width` characters at a blank, and after a semicolon.
Lines broken(const Words& words, int width) {
  Lines lines;
  int at = 0;
  for (const std::string& word : words) {
    const bool end = word == "\\;", comma = word == "\\,";
    int length =
        static_cast<int>(word.size() - static_cast<std::size_t>(std::ranges::count(word, '\\')));
    if (at > 0 && !comma && !end) {
      if (at + 1 + length > width) {
        ++lines.count;
        at = 0;
      } else {
        ++at;
      }
    }
    at += length;
    lines.longest = std::max(lines.longest, at);
    if (end && &word != &words.back()) {
      ++lines.count;
      at = 0;
    }
  }
  return lines;
}

std::string joined(const Words& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

// A box with text in it. `, f N` at its end is its width in characters.
void size_of_text(PatchBox& box, Words words, const std::string& kind) {
  int width = 60;
  bool fixed = false;
  if (words.size() > 2 && words[words.size() - 2] == "f" &&
      words[words.size() - 3].ends_with(",") && !words[words.size() - 3].ends_with("\\,")) {
    width = std::stoi(words.back());
    fixed = true;
    words.resize(words.size() - 2);
    words.back().pop_back();
  }
  box.text = joined(words);
  const Lines lines = broken(words, width);
  const int shown =
      fixed && kind == "obj" ? width : std::max(lines.longest, kind == "text" ? 1 : 3);
  box.width = character * shown + (kind == "msg" ? 11 : 5);
  box.height = line * lines.count + (kind == "text" ? 3 : 6);
}

// What an abstraction of the library, or one beside the patch, shows of itself.
bool size_of_abstraction(PatchBox& box, const Words& words, const fs::path& folder) {
  if (words[0] == "gait.figure") {  // its size is its second argument, pixels per metre
    const double scale = words.size() > 2 ? std::stod(words[2]) : 100;
    box.width = static_cast<int>(2.4 * scale);
    box.height = static_cast<int>(2.2 * scale);
    return true;
  }
  for (const fs::path& place : {folder, folder / "../abstractions"}) {
    const fs::path file = place / (words[0] + ".pd");
    if (!fs::exists(file)) continue;
    const PatchWindow window = read_patch(file).front();
    if (!window.drawn) return false;
    box.width = window.drawn_width;
    box.height = window.drawn_height;
    return true;
  }
  return false;
}

void size_of_object(PatchBox& box, const Words& words, const fs::path& folder) {
  const auto number = [&](std::size_t i) { return i < words.size() ? std::stoi(words[i]) : 0; };
  box.text = joined(words);
  const std::string& name = words.empty() ? box.text : words[0];
  if (name == "cnv") {
    box.width = number(2), box.height = number(3), box.background = true;
  } else if (name == "hsl") {
    box.width = number(1) + 3, box.height = number(2);
  } else if (name == "vsl") {
    box.width = number(1), box.height = number(2) + 3;
  } else if (name == "tgl" || name == "bng") {
    box.width = box.height = number(1);
  } else if (name == "hradio") {
    box.width = number(1) * number(4), box.height = number(1);
  } else if (name == "vradio") {
    box.width = number(1), box.height = number(1) * number(4);
  } else if (name == "nbx") {
    box.width = number(1) * 9 + number(2), box.height = number(2);
  } else if (name == "vu") {
    box.width = number(1), box.height = number(2);
  } else if (words.empty() || !size_of_abstraction(box, words, folder)) {
    size_of_text(box, words, "obj");
  }
}

}  // namespace

std::vector<PatchWindow> read_patch(const fs::path& file) {
  std::vector<PatchWindow> done, open;
  for (const Words& words : statements(file)) {
    if (words.size() < 2) continue;
    const std::string what = words[0] + words[1];
    if (what == "#Ncanvas") {
      PatchWindow window;
      window.name = open.empty() ? file.filename().string() : words.at(6);
      window.width = std::stoi(words.at(4));
      window.height = std::stoi(words.at(5));
      open.push_back(window);
      continue;
    }
    if (open.empty() || words.size() < 4) continue;
    if (what == "#Xcoords") {
      open.back().drawn = words.size() > 8 && words[8] != "0";
      open.back().drawn_width = std::stoi(words.at(6));
      open.back().drawn_height = std::stoi(words.at(7));
      continue;
    }
    PatchBox box;
    const Words rest(words.begin() + 4, words.end());
    if (what == "#Xobj")
      size_of_object(box, rest, file.parent_path());
    else if (what == "#Xmsg" || what == "#Xtext")
      size_of_text(box, rest, words[1]);
    else if (what == "#Xfloatatom" || what == "#Xsymbolatom")
      box = {words[1], 0, 0, std::stoi(rest.at(0)) * character + 9, line + 6};
    else if (what != "#Xrestore")
      continue;
    if (what == "#Xrestore") {
      const PatchWindow closed = open.back();
      open.pop_back();
      done.push_back(closed);
      size_of_text(box, rest, "obj");
      if (closed.drawn) box.width = closed.drawn_width, box.height = closed.drawn_height;
    }
    box.x = std::stoi(words[2]);
    box.y = std::stoi(words[3]);
    open.back().boxes.push_back(box);
  }
  if (open.size() != 1) throw Error(file.string() + ": its subpatches do not close");
  done.insert(done.begin(), open.front());
  return done;
}

std::vector<std::string> flaws(const PatchWindow& window) {
  std::vector<std::string> found;
  const auto named = [&](const PatchBox& box) { return window.name + ": '" + box.text + "'"; };
  for (std::size_t i = 0; i < window.boxes.size(); ++i) {
    const PatchBox& a = window.boxes[i];
    if (a.x < 0 || a.y < 0 || a.x + a.width > window.width || a.y + a.height > window.height)
      found.push_back(named(a) + " lies outside");
    for (std::size_t j = i + 1; j < window.boxes.size() && !a.background; ++j) {
      const PatchBox& b = window.boxes[j];
      if (!b.background && a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
          b.y < a.y + a.height)
        found.push_back(named(a) + " overlaps '" + b.text + "'");
    }
  }
  return found;
}

}  // namespace gait::testing
