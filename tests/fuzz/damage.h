// Damage to files, the same for the same seed: bytes and pieces changed, lost, doubled, numbers and
// words put where others were. What reads strangers' files must answer with an Error or with
// something sound, never in another way.
//
// GAIT_FUZZ_ROUNDS=N in the environment gives N times as many rounds, each time others.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace gait::testing {

inline int fuzz_rounds(int usual) {
  const char* more = std::getenv("GAIT_FUZZ_ROUNDS");
  return usual * (more ? std::clamp(std::atoi(more), 1, 100000) : 1);
}

class Damage {
 public:
  // `words`: what may be put in place of another word of the text.
  Damage(unsigned seed, std::vector<std::string> words) : random_(seed), words_(std::move(words)) {}

  std::size_t below(std::size_t limit) { return random_() % limit; }
  const std::string& word() { return words_[below(words_.size())]; }

  // One to four changes.
  std::string of(std::string text) {
    for (std::size_t left = 1 + below(4); left > 0; --left) {
      if (text.empty()) text = " ";
      change(text, below(text.size()));
    }
    return text;
  }

 private:
  void change(std::string& text, std::size_t at) {
    switch (below(12)) {
      case 0:
        text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        return;
      case 1:
        text[at] = static_cast<char>(below(256));
        return;
      case 2:
        text.erase(at, 1 + below(below(4) == 0 ? text.size() : 3));
        return;
      case 3:
        text.insert(at, text.substr(below(text.size()), below(200)));
        return;
      case 4:
        text.resize(at);
        return;
      case 5:
      case 6:
        replace_word(text, at);
        return;
      default:
        if (const std::size_t digit = text.find_first_of("0123456789", at);
            digit != std::string::npos)
          text[digit] = static_cast<char>('0' + below(10));
        return;
    }
  }

  void replace_word(std::string& text, std::size_t at) {
    constexpr std::string_view white = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(white, at);
    if (begin == std::string::npos) return;
    const std::size_t end = std::min(text.find_first_of(white, begin), text.size());
    text.replace(begin, end - begin, word());
  }

  std::mt19937 random_;
  std::vector<std::string> words_;
};

}  // namespace gait::testing
