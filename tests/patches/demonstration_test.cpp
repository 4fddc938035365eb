// Taught by demonstration in a patch: what moves beside what sounds meanwhile, and two and a half
// minutes of walking while sound goes on.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "patches/viterbi_patch.h"

namespace gait::testing {
namespace {

constexpr double settled = 20;  // frames: differences and the trajectory's past are whole

// A learner and, on one cord, what plays what it has learnt. `score` is for [qlist].
struct Demonstrated : Patch {
  int train, viterbi;
  Demonstrated(int in, int out, const std::string& score) {
    train = object("gait.train shown -in " + std::to_string(in) + " -out " + std::to_string(out) +
                   " -blocking");
    viterbi = object("gait.viterbi~ shown");
    const int map = object("gait.map shown"), synth = object("gait.synth shown");
    connect(viterbi, 4, map);
    connect(map, 0, synth);
    for (const auto& [name, to, inlet] :
         {std::tuple{"teach", train, 0}, {"sounds", train, 1}, {"seen", viterbi, 0}})
      connect(object(std::string("receive ") + name), 0, to, inlet);
    record(train, 0, "done");
    record(viterbi, 5, "seen");
    record(synth, 0, "played");
    file("score.txt", score);
    at_start({"read score.txt, rewind, bang"}, object("qlist"));
  }
};

std::string line(double after, const std::string& to, const Eigen::VectorXf& values) {
  return std::to_string(after) + " " + message_of(to, values) + ";\n";
}

// A hand that wanders, and a sound that follows it: pitch in Hz, brightness without unit.
struct Moment {
  Eigen::VectorXf hand{2}, sound{2};
  Moment(double seconds, double begun) {
    const double x = 0.5 + 0.4 * std::sin(1.3 * seconds + begun),
                 y = 0.5 + 0.4 * std::sin(1.9 * seconds + 2 * begun);
    hand << static_cast<float>(x), static_cast<float>(y);
    sound << static_cast<float>(200 + 400 * x * x), static_cast<float>(0.2 + 0.6 * y);
  }
};

TEST(Demonstration, of_a_sound_is_played_by_the_hand_alone) {
  GAIT_NEEDS_PD();
  std::string score;
  for (int take = 0; take < 3; ++take) {
    score += "0 teach record shown;\n";
    for (int frame = 0; frame < 180; ++frame) {
      const Moment moment(frame / 30.0, take);
      score += line(1000 / 30.0, "sounds out", moment.sound) + line(0, "teach in", moment.hand);
    }
    score += "0 teach stop;\n";
  }
  score += "100 teach train;\n100 seen rate 30;\n";
  std::vector<Moment> played;
  for (int frame = 0; frame < 200; ++frame) {
    played.emplace_back(frame / 30.0, 0.7);
    score += line(1000 / 30.0, "seen in", played.back().hand);
  }
  Demonstrated patch(2, 2, score);
  patch.quit_after(27000);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const auto out = run.numbers("played", "out");
  ASSERT_EQ(out.size(), played.size());
  for (int value = 0; value < 2; ++value) {
    double error = 0, mean = 0, squares = 0;
    for (std::size_t frame = 0; frame < out.size(); ++frame) {
      const double truth = played[frame].sound[value], count = static_cast<double>(out.size());
      error += std::abs(out[frame][static_cast<std::size_t>(value)] - truth) / count;
      mean += truth / count, squares += truth * truth / count;
    }
    const double deviation = std::sqrt(squares - mean * mean);
    std::printf("parameter %d: off by %.3f of its deviation\n", value, error / deviation);
    EXPECT_LT(error, 0.15 * deviation);  // 0.08 and 0.05 were seen
  }
}

// T14 §5: the map as a filter that knows what a walk is.
TEST(Demonstration, of_a_clean_skeleton_cleans_a_noisy_one) {
  GAIT_NEEDS_PD();
  constexpr float trouble = 0.1f;  // rad, deviation of the noise on each value and frame
  std::mt19937_64 random(11);
  std::normal_distribution<float> noise(0, trouble);
  const auto poses = [](const std::string& style, int take) {
    const Sequence streams = streams_of(make_walk(plan_of(style, take, 8)), *demo()->body);
    Eigen::MatrixXf both(streams.inputs.rows() + streams.outputs.rows(), streams.inputs.cols());
    both << streams.inputs.cast<float>(), streams.outputs.cast<float>();
    return both;
  };
  const auto disturbed = [&](const Eigen::MatrixXf& clean) {
    return Eigen::MatrixXf(clean.unaryExpr([&](float value) { return value + noise(random); }));
  };
  const double wait = 1000 / demo()->frame_rate;
  std::string score;
  double milliseconds = 1000;
  for (const char* style : {"proud", "sad"})
    for (int take = 1; take <= 2; ++take) {
      const Eigen::MatrixXf clean = poses(style, take), noisy = disturbed(clean);
      score += std::string("0 teach record ") + style + ";\n";
      for (int frame = 0; frame < clean.cols(); ++frame)
        score += line(wait, "sounds out", clean.col(frame)) + line(0, "teach in", noisy.col(frame));
      score += "0 teach stop;\n";
      milliseconds += wait * static_cast<double>(clean.cols());
    }
  score += "100 teach train;\n100 seen rate " + std::to_string(demo()->frame_rate) + ";\n";
  const Eigen::MatrixXf clean = poses("sad", 55), noisy = disturbed(clean);
  for (int frame = 0; frame < clean.cols(); ++frame)
    score += line(wait, "seen in", noisy.col(frame));
  milliseconds += wait * static_cast<double>(clean.cols());
  Demonstrated patch(static_cast<int>(clean.rows()), static_cast<int>(clean.rows()), score);
  patch.quit_after(milliseconds - 500);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const auto out = run.numbers("played", "out");
  ASSERT_EQ(out.size(), static_cast<std::size_t>(clean.cols()));
  double before = 0, after = 0, count = 0;
  for (auto frame = static_cast<int>(settled); frame < clean.cols(); ++frame)
    for (int value = 0; value < clean.rows(); ++value, ++count) {
      const double truth = clean(value, frame);
      before += std::pow(noisy(value, frame) - truth, 2);
      after += std::pow(
          out[static_cast<std::size_t>(frame)][static_cast<std::size_t>(value)] - truth, 2);
    }
  before = std::sqrt(before / count), after = std::sqrt(after / count);
  std::printf("noise %.3f rad, left of it %.3f rad\n", before, after);
  EXPECT_LT(after, 0.5 * before);
}

// Recorded as walked, then learnt in the background while blocks of sound are counted.
TEST(Demonstration, of_five_walks_is_learnt_without_a_long_tick) {
  GAIT_NEEDS_PD();
  Patch patch;
  patch.object("gait.model gait-demo -blocking");
  const int walker = patch.object("gait.pca"), train = patch.object("gait.train five");
  const int ticks = patch.object("ticks~"), begun = patch.object("receive begun");
  patch.connect(walker, 0, train);
  patch.record(train, 0, "done");
  std::string score;
  for (const char* style : {"sad", "proud", "drunk", "heavy", "in-a-hurry"})
    score += std::string("0 walk style ") + style + ";\n0 walk start;\n1000 teach record " + style +
             ";\n30000 teach stop;\n0 walk stop;\n";
  score += "100 ticks bang;\n0 ticks 0;\n0 begun bang;\n0 teach train;\n";
  patch.file("score.txt", score);
  patch.at_start({"read score.txt, rewind, bang"}, patch.object("qlist"));
  for (const auto& [name, to] : {std::pair{"teach", train}, {"walk", walker}, {"ticks", ticks}})
    patch.connect(patch.object(std::string("receive ") + name), 0, to);
  // What it took on the wall's clock, and the end as soon as it is learnt.
  const int real = patch.object("realtime"), end = patch.object("t b b b"),
            print = patch.object("print seconds"), wait = patch.object("del 100"),
            quit = patch.message("; pd quit");
  patch.connect(begun, 0, real);
  patch.connect(train, 0, end);
  patch.connect(end, 2, real, 1);
  patch.connect(end, 1, wait);
  patch.connect(real, 0, print);
  const int last = patch.object("t b b");
  patch.connect(wait, 0, last);
  patch.connect(last, 1, ticks);
  patch.connect(last, 0, quit);
  patch.dsp();
  const PdRun run = run_undisturbed(patch, 1000);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  const auto done = run.numbers("done", "done");
  ASSERT_EQ(done.size(), 1u) << run.log;
  EXPECT_GE(done[0][0], 0.9);
  double milliseconds = 0;
  const std::size_t took = run.log.find("seconds: ");
  ASSERT_NE(took, std::string::npos) << run.log;
  ASSERT_EQ(std::sscanf(run.log.c_str() + took, "seconds: %lf", &milliseconds), 1);
  std::printf("learnt in %.1f s of the wall's clock\n", milliseconds / 1000);
  int parts = 0;
  for (std::size_t at = run.log.find("ticks: "); at != std::string::npos;
       at = run.log.find("ticks: ", at + 1), ++parts) {
    double mean = 0, longest = 0;
    ASSERT_EQ(std::sscanf(run.log.c_str() + at, "ticks: %lf %lf", &mean, &longest), 2);
    std::printf("%s: mean tick %.1f us, longest %.0f us\n", parts == 0 ? "recording" : "learning",
                mean, longest);
    if (can_watch()) {
      EXPECT_LT(longest, 1000) << run.log;
    }
  }
  EXPECT_EQ(parts, 2);
}

// A hand that rests between strokes: each begins anew, so each is told.
TEST(Demonstration, of_one_gesture_twice_is_told_twice) {
  GAIT_NEEDS_PD();
  const auto stroke = [](const std::string& to, const std::string& what, double size) {
    std::string text;
    for (int frame = 0; frame < 30; ++frame) {
      const double s = frame / 29.0;
      Eigen::VectorXf at(2);
      if (what == "up")
        at << 0.1f, static_cast<float>(size * s);
      else
        at << static_cast<float>(size * std::sin(6.3 * s)), static_cast<float>(size * (1 - s));
      text += line(1000 / 30.0, to + " in", at);
    }
    return text;
  };
  std::string score;
  for (int take = 0; take < 4; ++take)
    for (const char* what : {"up", "wave"})
      score += std::string("500 teach record ") + what + ";\n" +
               stroke("teach", what, 1 + 0.1 * take) + "0 teach stop;\n";
  score += "100 teach train;\n";
  for (int times = 0; times < 2; ++times)
    score += "1000 seen rate 30;\n" + stroke("seen", "up", 1.1);
  Demonstrated patch(2, 0, score);
  patch.quit_after(20000);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  int strokes = 0, told = 0;
  bool fresh = false;
  for (const std::string& said : run.recorded("seen")) {
    if (said == "stream 1") fresh = true, ++strokes;
    if (said.starts_with("step ")) told += fresh, fresh = false;
  }
  EXPECT_EQ(strokes, 2);
  EXPECT_EQ(told, 2);
}

}  // namespace
}  // namespace gait::testing
