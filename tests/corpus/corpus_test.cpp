// What the corpus holds: styles, cycles, phases, seeds.
#include "gait/corpus/corpus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "gait/error.h"
#include "walked_body.h"

namespace gait {
namespace {

using testing::corpus;

TEST(Corpus, holds_as_many_cycles_of_each_style_as_the_paper) {
  // Tilmanne and Dutoit 2010, Table 1.
  const std::map<std::string, int> table{{"proud", 21},      {"decided", 15},   {"sad", 31},
                                         {"cat-walk", 25},   {"drunk", 38},     {"cool", 23},
                                         {"afraid", 16},     {"tiptoeing", 18}, {"heavy", 23},
                                         {"in-a-hurry", 19}, {"manly", 18}};
  std::map<std::string, int> cycles, takes;
  for (const CorpusWalk& walk : corpus()) {
    cycles[walk.style] += static_cast<int>(cycles_between(walk.contacts).size());
    EXPECT_EQ(walk.take, ++takes[walk.style]);
  }
  EXPECT_EQ(cycles, table);
  for (const auto& [style, count] : takes) {
    EXPECT_GE(count, 4) << style << ": cross-validation over clips needs several";
    EXPECT_LE(count, 8) << style;
  }
}

TEST(Corpus, walks_on_before_the_first_and_after_the_last_counted_contact) {
  for (const CorpusWalk& walk : corpus()) {
    EXPECT_EQ(walk.contacts.front().foot, Foot::right);
    EXPECT_EQ(walk.contacts.back().foot, Foot::right);
    EXPECT_GE(walk.contacts.front().frame, 9) << walk.clip.name;
    EXPECT_GE(walk.clip.frames() - walk.contacts.back().frame, 5) << walk.clip.name;
    for (std::size_t i = 1; i < walk.contacts.size(); ++i)
      EXPECT_EQ(walk.contacts[i].foot, other(walk.contacts[i - 1].foot));
  }
}

TEST(Corpus, is_the_same_for_a_seed_and_another_for_another) {
  const std::vector<CorpusWalk> again = make_corpus(1), another = make_corpus(2);
  ASSERT_EQ(again.size(), corpus().size());
  ASSERT_EQ(another.size(), corpus().size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    const CorpusWalk& walk = corpus()[i];
    ASSERT_EQ(again[i].clip.rotations.size(), walk.clip.rotations.size());
    for (std::size_t k = 0; k < walk.clip.rotations.size(); ++k)
      ASSERT_EQ(again[i].clip.rotations[k].coeffs(), walk.clip.rotations[k].coeffs());
    EXPECT_EQ(again[i].clip.translations, walk.clip.translations);
    EXPECT_EQ(again[i].contacts, walk.contacts);
    EXPECT_NE(another[i].clip.translations, walk.clip.translations);
  }
}

TEST(Corpus, phase_is_zero_at_the_right_contact_and_half_at_the_left) {
  for (const CorpusWalk& walk : corpus()) {
    ASSERT_EQ(walk.phase.size(), static_cast<std::size_t>(walk.clip.frames()));
    // A contact's frame is up to one frame late, so its phase is up to one frame's share on.
    for (std::size_t i = 0; i + 1 < walk.contacts.size(); ++i) {
      const int begin = walk.contacts[i].frame, end = walk.contacts[i + 1].frame;
      const double start = walk.contacts[i].foot == Foot::right ? 0.0 : 0.5;
      const double a_frame = 0.5 / (end - begin - 1);
      const double first = walk.phase[static_cast<std::size_t>(begin)];
      EXPECT_GE(first, start) << walk.clip.name;
      EXPECT_LT(first, start + a_frame) << walk.clip.name;
      // Linear between contacts: equal increments, all below the next contact's phase.
      const double increment = walk.phase[static_cast<std::size_t>(begin) + 1] - first;
      for (int frame = begin; frame + 1 < end; ++frame)
        EXPECT_NEAR(walk.phase[static_cast<std::size_t>(frame) + 1] -
                        walk.phase[static_cast<std::size_t>(frame)],
                    increment, 1e-9);
      EXPECT_LT(walk.phase[static_cast<std::size_t>(end) - 1], start + 0.5);
    }
  }
}

// Speed along +Z between the first and last contact, over clips of a style.
std::map<std::string, double> speeds() {
  std::map<std::string, double> distance, time;
  for (const CorpusWalk& walk : corpus()) {
    const int begin = walk.contacts.front().frame, end = walk.contacts.back().frame;
    distance[walk.style] += walk.clip.translation(end)[0].z() - walk.clip.translation(begin)[0].z();
    time[walk.style] += (end - begin) / walk.clip.frame_rate;
  }
  for (auto& [style, metres] : distance) metres /= time[style];
  return distance;
}

TEST(Corpus, styles_differ_in_speed_as_their_names_say) {
  auto speed = speeds();
  for (const WalkStyle& style : corpus_styles())
    // Step lengths and durations vary, so the walks' own speed is near the style's, not at it.
    EXPECT_NEAR(speed[style.name] / corpus_leg_length, style.speed, 0.06 * style.speed)
        << style.name;
  EXPECT_GT(speed["in-a-hurry"], speed["decided"]);
  EXPECT_GT(speed["decided"], 1.3 * speed["proud"]);
  EXPECT_LT(speed["sad"], 0.8 * speed["proud"]);
  EXPECT_LT(speed["afraid"], 0.8 * speed["sad"]);
}

TEST(Corpus, no_two_cycles_last_alike_and_drunk_ones_differ_most) {
  std::map<std::string, std::vector<double>> seconds;
  for (const WalkStyle& style : corpus_styles()) {
    int take = 0;
    for (const int cycles : cycles_of_takes(style.cycles)) {
      WalkPlan plan{.style = style, .cycles = cycles};
      plan.take = ++take;
      const SyntheticWalk walk(plan);
      for (std::size_t i = 2; i < walk.contacts().size(); i += 2)
        seconds[style.name].push_back(walk.contacts()[i].time - walk.contacts()[i - 2].time);
    }
    EXPECT_EQ(seconds[style.name].size(), static_cast<std::size_t>(style.cycles));
    const std::set<double> distinct(seconds[style.name].begin(), seconds[style.name].end());
    EXPECT_EQ(distinct.size(), seconds[style.name].size()) << style.name;
  }
  const auto spread = [](const std::vector<double>& values) {
    double sum = 0, squares = 0;
    for (const double v : values) sum += v, squares += v * v;
    const double mean = sum / static_cast<double>(values.size());
    return std::sqrt(squares / static_cast<double>(values.size()) - mean * mean) / mean;
  };
  for (const auto& [style, values] : seconds) {
    EXPECT_GT(spread(values), 0.003) << style;
    if (style != "drunk") {
      EXPECT_LT(spread(values), spread(seconds["drunk"])) << style;
    }
  }
}

TEST(Corpus, an_unknown_style_is_an_error_that_names_the_known_ones) {
  try {
    corpus_style("moonwalk");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("moonwalk"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("tiptoeing"), std::string::npos);
  }
  EXPECT_EQ(corpus_style("neutral").name, "neutral");
}

TEST(Corpus, a_walk_that_cannot_be_is_an_error) {
  WalkPlan plan{.style = corpus_style("sad")};
  plan.cycles = 0;
  EXPECT_THROW(make_walk(plan), Error);
  plan.cycles = 3;
  EXPECT_THROW(make_walk(plan, 0), Error);
  plan.cadence = {{1.0, 0.0}};
  EXPECT_THROW(make_walk(plan), Error);
  plan.cadence = {};
  plan.leg_length = -1;
  EXPECT_THROW(make_walk(plan), Error);
}

}  // namespace
}  // namespace gait
