#include "gait/play/recognise/decoder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <vector>

namespace gait {
namespace {

constexpr double frame_rate = 30;

// Labels of some states each with random durations, and who may follow whom.
std::shared_ptr<StateTables> tables_of(const std::vector<int>& states,
                                       const std::vector<std::vector<int>>& successors,
                                       unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> stay(0.3, 0.9);
  auto tables = std::make_shared<StateTables>();
  tables->successors = successors;
  for (std::size_t label = 0; label < states.size(); ++label) {
    tables->first_state.push_back(static_cast<int>(tables->states.size()));
    float before = 0;
    for (int i = 0; i < states[label]; ++i) {
      PlayedState state;
      const double p = stay(random);
      state.label = static_cast<int>(label);
      state.log_stay = static_cast<float>(std::log(p));
      state.log_leave = static_cast<float>(std::log(1 - p));
      state.mean_duration = static_cast<float>(1 / (1 - p) / frame_rate);
      state.before = before;
      before += state.mean_duration;
      tables->states.push_back(state);
    }
    tables->label_duration.push_back(before);
  }
  return tables;
}

// Three labels; after the first, two may follow, and the third may follow itself.
std::shared_ptr<StateTables> three_labels(unsigned seed) {
  return tables_of({2, 1, 2}, {{1, 2}, {0}, {0, 2}}, seed);
}

using Frames = std::vector<std::vector<float>>;

Frames random_frames(int count, int states, double deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(-5, deviation);
  Frames frames(count, std::vector<float>(states));
  for (auto& frame : frames)
    for (float& value : frame) value = static_cast<float>(normal(random));
  return frames;
}

// Log of the chance to go from a state to another by the tables, read anew from what they mean.
double log_transition(const StateTables& tables, int from, int to) {
  const auto& a = tables.states[from];
  const auto& b = tables.states[to];
  if (from == to) return a.log_stay;
  if (a.label == b.label && to == from + 1) return a.log_leave;
  const int states = static_cast<int>(tables.states.size());
  const bool last = from + 1 == states || tables.states[from + 1].label != a.label;
  const auto& next = tables.successors[a.label];
  if (last && to == tables.first_state[b.label] && std::count(next.begin(), next.end(), b.label))
    return a.log_leave - std::log(static_cast<double>(next.size()));
  return -std::numeric_limits<double>::infinity();
}

// The best of all paths over the first `count` frames, by trying every one.
std::vector<int> best_path_by_trying_all(const StateTables& tables, const Frames& frames,
                                         int count) {
  const int states = static_cast<int>(tables.states.size());
  std::vector<int> path(count), best;
  double best_score = -std::numeric_limits<double>::infinity();
  const std::function<void(int, double)> extend = [&](int frame, double score) {
    if (frame == count) {
      if (score > best_score) best_score = score, best = path;
      return;
    }
    for (int state = 0; state < states; ++state) {
      const double step = frame == 0 ? 0 : log_transition(tables, path[frame - 1], state);
      if (!std::isfinite(step)) continue;
      path[frame] = state;
      extend(frame + 1, score + step + frames[frame][state]);
    }
  };
  extend(0, 0);
  return best;
}

// The best path over the first `count` frames with a full table of where paths came from.
std::vector<int> best_path(const StateTables& tables, const Frames& frames, int count) {
  const int states = static_cast<int>(tables.states.size());
  std::vector<double> scores(frames[0].begin(), frames[0].end());
  std::vector<std::vector<int>> from(count, std::vector<int>(states));
  for (int frame = 1; frame < count; ++frame) {
    std::vector<double> next(states, -std::numeric_limits<double>::infinity());
    for (int to = 0; to < states; ++to)
      for (int state = 0; state < states; ++state) {
        const double score = scores[state] + log_transition(tables, state, to);
        if (score > next[to]) next[to] = score, from[frame][to] = state;
      }
    for (int to = 0; to < states; ++to) next[to] += frames[frame][to];
    scores = next;
  }
  std::vector<int> path(count);
  path[count - 1] =
      static_cast<int>(std::max_element(scores.begin(), scores.end()) - scores.begin());
  for (int frame = count - 1; frame > 0; --frame) path[frame - 1] = from[frame][path[frame]];
  return path;
}

double progress_along(const StateTables& tables, const std::vector<int>& path, int frame) {
  int time = 1;
  while (time <= frame && path[frame - time] == path[frame]) ++time;
  const PlayedState& state = tables.states[path[frame]];
  const double spent =
      std::min((time - 0.5) / frame_rate, static_cast<double>(state.mean_duration));
  return (state.before + spent) / tables.label_duration[state.label];
}

TEST(Decoder, decides_at_each_frame_as_the_best_of_all_paths) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto tables = three_labels(seed);
    const Frames frames = random_frames(8, 5, 1.5, seed + 100);
    Decoder decoder(tables, DecoderKind::viterbi, 0, 1, frame_rate);
    for (int frame = 0; frame < 8; ++frame) {
      decoder.advance(frames[frame]);
      const std::vector<int> best = best_path_by_trying_all(*tables, frames, frame + 1);
      EXPECT_EQ(decoder.state(), best.back()) << "seed " << seed << " frame " << frame;
      EXPECT_EQ(decoder.label(), tables->states[best.back()].label);
      ASSERT_EQ(decoder.weighted().size(), 1u);
      EXPECT_EQ(decoder.weighted()[0].state, best.back());
      EXPECT_NEAR(decoder.progress(), progress_along(*tables, best, frame), 1e-5);
    }
  }
}

TEST(Decoder, a_lag_as_long_as_the_walk_finds_the_best_path_of_the_whole) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto tables = three_labels(seed);
    const int count = 60;
    const Frames frames = random_frames(count, 5, 1.5, seed + 200);
    Decoder decoder(tables, DecoderKind::lag, count, 1, frame_rate);
    for (const auto& frame : frames) decoder.advance(frame);
    EXPECT_FALSE(decoder.decided());
    const std::vector<int> best = best_path(*tables, frames, count);
    for (int frame = 0; frame < count; ++frame) {
      const int back = count - 1 - frame;
      EXPECT_EQ(decoder.state_at_end(back), best[frame]) << "seed " << seed << " frame " << frame;
      EXPECT_NEAR(decoder.progress_at_end(back), progress_along(*tables, best, frame), 1e-5);
    }
  }
}

TEST(Decoder, with_lag_it_speaks_of_the_frame_that_many_frames_ago) {
  const int lag = 3, count = 80;
  int unlike_the_newest = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto tables = three_labels(seed);
    const Frames frames = random_frames(count, 5, 1.0, seed + 300);
    Decoder decoder(tables, DecoderKind::lag, lag, 1, frame_rate);
    EXPECT_EQ(decoder.lag(), lag);
    for (int frame = 0; frame < count; ++frame) {
      decoder.advance(frames[frame]);
      ASSERT_EQ(decoder.decided(), frame >= lag);
      if (!decoder.decided()) continue;
      const std::vector<int> best = best_path(*tables, frames, frame + 1);
      EXPECT_EQ(decoder.state(), best[frame - lag]);
      EXPECT_EQ(decoder.weighted()[0].state, best[frame - lag]);
      EXPECT_NEAR(decoder.progress(), progress_along(*tables, best, frame - lag), 1e-5);
      unlike_the_newest += best[frame - lag] != best[frame];
    }
  }
  EXPECT_GT(unlike_the_newest, 100);
}

TEST(Decoder, the_filters_weights_are_the_posteriors_of_a_plain_forward_recursion) {
  for (const double temper : {1.0, 0.1})
    for (unsigned seed = 0; seed < 10; ++seed) {
      const auto tables = three_labels(seed);
      const int states = 5;
      // Tempered ones may differ more, as they do when many dimensions agree.
      const Frames frames = random_frames(60, states, 1.5 / temper, seed + 400);
      Decoder decoder(tables, DecoderKind::forward, 0, static_cast<float>(temper), frame_rate);
      std::vector<double> alpha(states, 1.0 / states);
      for (std::size_t frame = 0; frame < frames.size(); ++frame) {
        decoder.advance(frames[frame]);
        std::vector<double> next(states, 0.0);
        for (int to = 0; to < states; ++to) {
          if (frame == 0) next[to] = alpha[to];
          for (int from = 0; from < states && frame > 0; ++from)
            next[to] += alpha[from] * std::exp(log_transition(*tables, from, to));
          next[to] *= std::exp(temper * frames[frame][to]);
        }
        double sum = 0;
        for (const double value : next) sum += value;
        for (double& value : next) value /= sum;
        alpha = next;

        EXPECT_NEAR(decoder.log_likelihood(), std::log(sum), 1e-3);
        std::map<int, double> weights;
        double kept = 0;
        for (const WeightedState& state : decoder.weighted()) {
          weights[state.state] = state.weight;
          kept += alpha[state.state];
        }
        ASSERT_EQ(weights.size(), decoder.weighted().size()) << "a state is named twice";
        for (int state = 0; state < states; ++state) {
          if (weights.contains(state))
            EXPECT_NEAR(weights[state], alpha[state] / kept, 1e-4);
          else
            EXPECT_LT(alpha[state], 0.0051);
        }
        const auto best = std::max_element(alpha.begin(), alpha.end());
        EXPECT_NEAR(alpha[decoder.state()], *best, 1e-4);
      }
    }
}

TEST(Decoder, the_filter_names_the_likeliest_states_and_their_weights_sum_to_one) {
  // Thirty states in a row, all nearly alike: more than a decision can name.
  const auto tables = tables_of({15, 15}, {{1}, {0}}, 7);
  Decoder decoder(tables, DecoderKind::forward, 0, 0.1f, frame_rate);
  for (const auto& frame : random_frames(200, 30, 3, 8)) {
    decoder.advance(frame);
    const auto states = decoder.weighted();
    ASSERT_GE(states.size(), 1u);
    ASSERT_LE(states.size(), static_cast<std::size_t>(Decoder::most_weighted));
    float sum = 0;
    for (const WeightedState& state : states) {
      sum += state.weight;
      EXPECT_LE(state.weight, states[0].weight) << "the first is the likeliest";
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    EXPECT_EQ(states[0].state, decoder.state());
  }
}

TEST(Decoder, when_more_states_are_likely_than_can_be_named_the_least_likely_are_left_out) {
  const auto tables = tables_of({15, 15}, {{1}, {0}}, 7);
  Decoder decoder(tables, DecoderKind::forward, 0, 1, frame_rate);
  // At the first frame the posterior is the emission itself: twelve states, in no order.
  std::vector<float> frame(30, -50.0f);
  const int order[12] = {3, 29, 11, 0, 17, 5, 8, 23, 14, 20, 26, 2};
  for (int i = 0; i < 12; ++i) frame[order[i]] = -0.1f * static_cast<float>(i);
  decoder.advance(frame);
  std::vector<int> named;
  for (const WeightedState& state : decoder.weighted()) named.push_back(state.state);
  std::sort(named.begin(), named.end());
  std::vector<int> likeliest(order, order + Decoder::most_weighted);
  std::sort(likeliest.begin(), likeliest.end());
  EXPECT_EQ(named, likeliest);
}

TEST(Decoder, after_a_reset_it_decides_as_a_new_one) {
  const auto tables = three_labels(3);
  for (const DecoderKind kind : {DecoderKind::viterbi, DecoderKind::forward, DecoderKind::lag}) {
    Decoder used(tables, kind, 3, 0.5f, frame_rate), fresh(tables, kind, 3, 0.5f, frame_rate);
    for (const auto& frame : random_frames(50, 5, 2, 1)) used.advance(frame);
    used.reset();
    EXPECT_FALSE(used.decided());
    for (const auto& frame : random_frames(50, 5, 2, 2)) {
      used.advance(frame);
      fresh.advance(frame);
      EXPECT_EQ(used.state(), fresh.state());
      EXPECT_EQ(used.progress(), fresh.progress());
      EXPECT_EQ(used.log_likelihood(), fresh.log_likelihood());
      EXPECT_EQ(used.decided(), fresh.decided());
      ASSERT_EQ(used.weighted().size(), fresh.weighted().size());
      for (std::size_t i = 0; i < used.weighted().size(); ++i)
        EXPECT_EQ(used.weighted()[i].weight, fresh.weighted()[i].weight);
    }
  }
}

TEST(Decoder, an_hour_of_likelihoods_of_many_dimensions_does_not_wear_it_out) {
  // Log-likelihoods of some eighty dimensions: hundreds below zero, and thousands for what is far.
  const auto tables = tables_of({4, 4}, {{1}, {0}}, 11);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> far(500, 5000);
  for (const DecoderKind kind : {DecoderKind::viterbi, DecoderKind::forward, DecoderKind::lag}) {
    Decoder decoder(tables, kind, 3, 0.1f, frame_rate);
    std::vector<float> frame(8);
    int wrong = 0;
    const int frames = 3600 * 30, frames_per_state = 5;
    for (int i = 0; i < frames; ++i) {
      const int truth = i / frames_per_state % 8;
      for (int state = 0; state < 8; ++state)
        frame[state] = static_cast<float>(state == truth ? -300 : -300 - far(random));
      decoder.advance(frame);
      if (i < decoder.lag()) continue;
      const int spoken_of = (i - decoder.lag()) / frames_per_state % 8;
      wrong += decoder.state() != spoken_of;
    }
    EXPECT_EQ(wrong, 0);
  }
}

}  // namespace
}  // namespace gait
