#include "gait/motion/roles/joint_words.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace gait {
namespace {

bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Names in other scripts become words of the dictionary. Longer ones first: an ankle is 'leg neck'.
constexpr std::array<std::pair<std::string_view, std::string_view>, 43> foreign{{
    {"下半身", "_hips_"},
    {"上半身", "_spine_"},
    {"センター", "_center_"},
    {"グルーブ", "_groove_"},
    {"つま先", "_toes_"},
    {"太もも", "_thigh_"},
    {"ふくらはぎ", "_shin_"},
    {"くるぶし", "_ankle_"},
    {"ひじ", "_elbow_"},
    {"ひざ", "_knee_"},
    {"足首", "_ankle_"},
    {"手首", "_wrist_"},
    {"足先", "_toes_"},
    {"大腿", "_thigh_"},
    {"下腿", "_shin_"},
    {"上腕", "_upperarm_"},
    {"前腕", "_forearm_"},
    {"鎖骨", "_collar_"},
    {"骨盤", "_pelvis_"},
    {"背骨", "_spine_"},
    {"脊椎", "_spine_"},
    {"ＩＫ", "_ik_"},
    {"親", "_root_"},
    {"捩", "_twist_"},
    {"肘", "_elbow_"},
    {"膝", "_knee_"},
    {"肩", "_shoulder_"},
    {"腕", "_arm_"},
    {"手", "_hand_"},
    {"足", "_leg_"},
    {"首", "_neck_"},
    {"頭", "_head_"},
    {"腰", "_hips_"},
    {"胸", "_chest_"},
    {"左", "_left_"},
    {"右", "_right_"},
    {"ä", "ae"},
    {"ö", "oe"},
    {"ü", "ue"},
    {"Ä", "Ae"},
    {"Ö", "Oe"},
    {"Ü", "Ue"},
    {"ß", "ss"},
}};

std::string in_our_letters(std::string_view name) {
  std::string text;
  while (!name.empty()) {
    const auto known = static_cast<unsigned char>(name[0]) < 0x80
                           ? foreign.end()
                           : std::ranges::find_if(foreign, [&](const auto& entry) {
                               return name.starts_with(entry.first);
                             });
    if (known != foreign.end()) {
      text += known->second;
      name.remove_prefix(known->first.size());
    } else {
      text += name[0];
      name.remove_prefix(1);
    }
  }
  return text;
}

struct Word {
  std::string text;      // lower case, no digits
  bool separate = true;  // begins after a separator, not just a capital letter
};
using Words = std::vector<Word>;

// "mixamorig:LeftUpLeg1" -> left, up, leg. What stands before the last colon is a name space.
Words words_of(std::string_view name) {
  if (const std::size_t mark = name.find_last_of(":|"); mark != std::string_view::npos)
    name.remove_prefix(mark + 1);
  const std::string letters = in_our_letters(name);
  name = letters;
  Words words;
  bool separate = true, in_word = false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!is_lower(c) && !is_upper(c)) {
      in_word = false;
      separate = separate || !is_digit(c);
      continue;
    }
    // A capital begins a word after a small letter, and as the last of several ("LHip": L, Hip).
    if (in_word && is_upper(c) &&
        (is_lower(name[i - 1]) || (i + 1 < name.size() && is_lower(name[i + 1]))))
      in_word = false;
    if (!in_word) words.push_back({{}, separate});
    words.back().text += is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c;
    in_word = true;
    separate = false;
  }
  return words;
}

template <std::size_t size>
bool is_one_of(std::string_view word, const std::array<std::string_view, size>& words) {
  return std::ranges::find(words, word) != words.end();
}

constexpr std::array<std::string_view, 10> left_words{"l",     "left", "linker", "linkes", "linke",
                                                      "links", "lft",  "lt",     "li",     "lf"};
constexpr std::array<std::string_view, 10> right_words{
    "r", "right", "rechter", "rechtes", "rechte", "rechts", "rgt", "rt", "rg", "re"};

Side side_of(std::string_view word) {
  if (is_one_of(word, left_words)) return Side::left;
  return is_one_of(word, right_words) ? Side::right : Side::none;
}

// "lf" is left beside "rt", but the left lower one of "LFArm" and "RFArm".
void join_lf(std::vector<Words>& rig) {
  const auto has_right = [](const Words& words) {
    return std::ranges::any_of(words, [](const Word& word) { return word.text == "rt"; });
  };
  if (std::ranges::any_of(rig, has_right)) return;
  for (Words& words : rig)
    for (std::size_t i = 0; i + 1 < words.size(); ++i)
      if (words[i].text == "lf" && !words[i + 1].separate) {
        words[i].text += words[i + 1].text;
        words.erase(words.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      }
}

// Ends of bones: no part of the body moves by them, in whatever rig.
bool is_end(std::string_view word) {
  constexpr std::array<std::string_view, 4> ends{"end", "nub", "tip", "top"};
  return is_one_of(word, ends);
}

// Helpers of animators.
bool is_helper(std::string_view word) {
  constexpr std::array<std::string_view, 10> helpers{
      "ik", "pole", "target", "ctrl", "goal", "effector", "fk", "mch", "helper", "dummy"};
  return is_one_of(word, helpers);
}

bool is_twist(std::string_view word) { return word == "twist" || word == "roll" || word == "tw"; }

// Words that say what a joint is for the program, not for the body.
bool is_noise(std::string_view word) {
  constexpr std::array<std::string_view, 18> noise{"jnt", "joint", "jt",  "bone", "bn",   "bind",
                                                   "bnd", "ref",   "def", "org",  "skin", "skel",
                                                   "rig", "bend",  "sk",  "m",    "c",    "mid"};
  return is_one_of(word, noise);
}

bool in_dictionary(std::string_view word) {
  return part_named(word, false) != Part::unknown || part_named(word, true) != Part::unknown ||
         is_end(word) || is_twist(word);
}

// Takes off words with which most names begin (or end): an asset's name, 'CC_Base_', '_JNT'.
void drop_shared(std::vector<Words>& rig, bool front) {
  constexpr int fewest_names = 6;
  const auto edge = [&](const Words& words) -> const Word& {
    return front ? words.front() : words.back();
  };
  for (;;) {
    std::map<std::string_view, int> count;
    int names = 0;
    for (const Words& words : rig)
      if (words.size() > 1) ++count[edge(words).text], ++names;
    if (names < fewest_names) return;
    const auto most =
        std::ranges::max_element(count, {}, [](const auto& entry) { return entry.second; });
    // Sides and parts are shared by half of a rig's names at most.
    const bool says = side_of(most->first) != Side::none || in_dictionary(most->first);
    if (most->second < (says ? 0.9 : 0.6) * static_cast<double>(rig.size())) return;
    const std::string shared(most->first);
    for (Words& words : rig)
      if (words.size() > 1 && edge(words).text == shared) {
        if (front) words[1].separate = true;
        words.erase(front ? words.begin() : words.end() - 1);
      }
  }
}

// A name in one word: "lfemur", "leftupleg", "handleft", "lthightwist".
NameMeaning in_one_word(std::string_view word) {
  for (const std::string_view ending : {"twist", "roll", "bend", "joint", "jnt", "bone"})
    if (word.size() > ending.size() + 2 && word.ends_with(ending)) {
      NameMeaning rest = in_one_word(word.substr(0, word.size() - ending.size()));
      if (rest.part == Part::unknown) break;
      rest.twist = rest.twist || is_twist(ending);
      return rest;
    }
  for (const auto& [texts, side] :
       {std::pair{left_words, Side::left}, std::pair{right_words, Side::right}})
    for (const std::string_view text : texts) {
      if (word.starts_with(text))
        if (const Part part = part_named(word.substr(text.size()), true); part != Part::unknown)
          return {side, part};
      if (text.size() > 1 && word.ends_with(text))
        if (const Part part = part_named(word.substr(0, word.size() - text.size()), true);
            part != Part::unknown)
          return {side, part};
    }
  return {};
}

// One word, once the side is known: also with a twist behind it.
Part sided_part(std::string_view word, bool& twist) {
  for (const std::string_view ending : {"", "twist", "roll", "bend", "joint", "jnt", "bone"})
    if (word.ends_with(ending))
      if (const Part part = part_named(word.substr(0, word.size() - ending.size()), true);
          part != Part::unknown) {
        twist = twist || is_twist(ending);
        return part;
      }
  return Part::unknown;
}

// "leg, upper" and "upper, leg" are the same.
std::string joined(std::span<const Word> words) {
  constexpr std::array<std::string_view, 9> before{"up",  "upper", "upr", "low", "lower",
                                                   "lwr", "lo",    "mid", "fore"};
  constexpr std::array<std::pair<std::string_view, std::string_view>, 2> spelt{
      {{"upr", "upper"}, {"lwr", "lower"}}};
  std::string text;
  for (const bool first : {true, false})
    for (const Word& word : words)
      if (is_one_of(word.text, before) == first) {
        const auto full = std::ranges::find(spelt, word.text,
                                            &std::pair<std::string_view, std::string_view>::first);
        text += full == spelt.end() ? std::string_view(word.text) : full->second;
      }
  return text;
}

// Segments and joints of the spine in Xsens' own naming, with anything added to them: "T12",
// "jL5S1", "Actor_T8_JNT".
Part vertebra(std::string_view name) {
  using Segment = std::pair<std::string_view, Part>;
  constexpr std::array<Segment, 10> segments{{{"C1Head", Part::head},
                                              {"T1C7", Part::neck},
                                              {"L5S1", Part::spine},
                                              {"L4L3", Part::spine},
                                              {"L1T12", Part::spine},
                                              {"T9T8", Part::spine},
                                              {"T12", Part::spine},
                                              {"L5", Part::spine},
                                              {"L3", Part::spine},
                                              {"T8", Part::spine}}};
  const auto alone = [](char c) { return !is_lower(c) && !is_upper(c) && !is_digit(c); };
  for (const auto& [segment, part] : segments) {
    const std::size_t at = name.find(segment);
    if (at == std::string_view::npos) continue;
    std::string_view before = name.substr(0, at), behind = name.substr(at + segment.size());
    if (before.ends_with('j')) before.remove_suffix(1);
    if ((before.empty() || alone(before.back())) &&
        (behind.empty() || alone(behind[0]) || behind == "Joint" || behind == "Bone"))
      return part;
  }
  return Part::unknown;
}

NameMeaning meaning_of(Words words) {
  NameMeaning meaning;
  if (std::ranges::any_of(
          words, [](const Word& word) { return is_end(word.text) || is_helper(word.text); }))
    return {};
  for (auto word = words.begin(); word != words.end();) {
    const Side side = side_of(word->text);
    const bool says_side = side != Side::none && (meaning.side == Side::none ||
                                                  (meaning.side == side && word->text.size() > 1));
    if (says_side) meaning.side = side;
    if (is_twist(word->text)) meaning.twist = true;
    if (!says_side && !(is_twist(word->text) && words.size() > 1)) {
      ++word;
      continue;
    }
    const bool separate = word->separate;
    word = words.erase(word);
    if (word != words.end()) word->separate = word->separate || separate;
  }
  while (words.size() > 1 && is_noise(words.back().text)) words.pop_back();
  while (words.size() > 1 && is_noise(words.front().text)) {
    words.erase(words.begin());
    words.front().separate = true;
  }
  // The whole name first; then without what stands before a separator: "Bip01_Pelvis".
  for (std::size_t first = 0; first < words.size(); ++first) {
    if (!words[first].separate) continue;
    const std::string text = joined(std::span(words).subspan(first));
    if (meaning.side == Side::none) {
      meaning.part = part_named(text, false);
      if (meaning.part != Part::unknown) return meaning;
      if (NameMeaning whole = in_one_word(text); whole.part != Part::unknown) {
        whole.twist = whole.twist || meaning.twist;
        return whole;
      }
    } else if (const Part part = sided_part(text, meaning.twist); part != Part::unknown) {
      meaning.part = part;
      return meaning;
    }
  }
  return {meaning.side, Part::unknown, meaning.twist};
}

}  // namespace

std::vector<NameMeaning> meanings_of(std::span<const std::string_view> names) {
  std::vector<Words> rig;
  for (const std::string_view name : names) rig.push_back(words_of(name));
  drop_shared(rig, true);
  drop_shared(rig, false);
  join_lf(rig);
  std::vector<NameMeaning> meanings;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (const Part part = vertebra(names[i]); part != Part::unknown)
      meanings.push_back({Side::none, part});
    else if (names[i].starts_with("__"))  // MakeHuman's mounts, named as the joint that they carry
      meanings.push_back({});
    else
      meanings.push_back(meaning_of(std::move(rig[i])));
  }
  return meanings;
}

}  // namespace gait
