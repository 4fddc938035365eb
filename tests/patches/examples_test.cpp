// The examples, played without a window and without waiting: that they sound, and how.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "patches/patch.h"

namespace gait::testing {
namespace {

namespace fs = std::filesystem;

constexpr double rate = 48000;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

struct Sound {
  std::string log;
  std::vector<std::string> errors;
  std::vector<float> left, right;

  double peak() const {
    double most = 0;
    for (const auto* side : {&left, &right})
      for (const float value : *side) most = std::max(most, std::abs(static_cast<double>(value)));
    return most;
  }
  double mean() const {
    return std::accumulate(left.begin(), left.end(), 0.0) / static_cast<double>(left.size());
  }
  double level() const {
    double sum = 0;
    for (const float value : left) sum += static_cast<double>(value) * static_cast<double>(value);
    return std::sqrt(sum / static_cast<double>(left.size()));
  }
  // Root mean square of the frequency, Hz: the deviation of the sound's slope over its own.
  double brightness() const {
    double slope = 0;
    for (std::size_t i = 1; i < left.size(); ++i)
      slope += std::pow(static_cast<double>(left[i] - left[i - 1]), 2);
    return std::sqrt(slope / static_cast<double>(left.size())) / level() * rate / (2 * M_PI);
  }
  // Rises of the level over 20 ms by half, a second.
  double onsets() const {
    constexpr std::size_t window = 960;
    std::vector<double> levels;
    for (std::size_t at = 0; at + window <= left.size(); at += window) {
      double sum = 1e-9;
      for (std::size_t i = at; i < at + window; ++i)
        sum += static_cast<double>(left[i]) * static_cast<double>(left[i]);
      levels.push_back(std::sqrt(sum));
    }
    int count = 0;
    for (std::size_t i = 2; i < levels.size(); ++i)
      if (levels[i] > 1.5 * levels[i - 1] && levels[i - 1] <= 1.5 * levels[i - 2]) ++count;
    return count / (static_cast<double>(left.size()) / rate);
  }
  // The greatest step from sample to sample: a click of a switched sound is as high as the sound.
  double jump() const {
    double most = 0;
    for (std::size_t i = 1; i < left.size(); ++i)
      most = std::max(most, std::abs(static_cast<double>(left[i] - left[i - 1])));
    return most;
  }
};

// What soundfiler wrote: two channels of 32-bit floats.
void read_wave(const fs::path& file, Sound& sound) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::size_t at = bytes.find("data");
  if (at == std::string::npos) return;
  for (std::size_t i = at + 8; i + 8 <= bytes.size(); i += 8) {
    float pair[2];
    std::memcpy(pair, bytes.data() + i, 8);
    sound.left.push_back(pair[0]);
    sound.right.push_back(pair[1]);
  }
}

// A message to one of the example's names, so many milliseconds after the beginning.
struct Told {
  double at;
  std::string text;
};

// Plays an example: its names are made known as ex-NAME, its [dac~] is heard from `from` to `to`
// (seconds). `live`: in real time.
Sound play(const std::string& example, const std::vector<Told>& messages, double from, double to,
           bool live = false) {
  std::string folder = ::testing::TempDir() + "gait_example_XXXXXX";
  EXPECT_NE(mkdtemp(folder.data()), nullptr);
  fs::create_directory(folder + "/parts");
  for (const auto& entry : fs::recursive_directory_iterator(GAIT_SOURCE "/examples")) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path());
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (entry.path().filename() == example + ".pd") {
      text = replaced(text, "\\$0-", "ex-");
      text = replaced(text, " dac~;", " heard;");
      text = replaced(text, "gait.bvh gait-demo", "gait.bvh gait-demo -blocking");
    }
    std::ofstream(fs::path(folder) / fs::relative(entry.path(), GAIT_SOURCE "/examples")) << text;
  }
  std::ofstream(folder + "/heard.pd")
      << "#N canvas 0 0 300 200 12;\n#X obj 10 10 inlet~;\n#X obj 100 10 inlet~;\n"
         "#X obj 10 60 tabwrite~ heard-left;\n#X obj 100 60 tabwrite~ heard-right;\n"
         "#X obj 200 10 r heard;\n#X connect 0 0 2 0;\n#X connect 1 0 3 0;\n"
         "#X connect 4 0 2 0;\n#X connect 4 0 3 0;\n";
  Patch patch;
  patch.object("gait.model gait-demo -blocking");
  const std::string samples = std::to_string(static_cast<int>((to - from) * rate));
  patch.object("table heard-left " + samples);
  patch.object("table heard-right " + samples);
  const int begin = patch.object("loadbang");
  const auto later = [&](double milliseconds, const std::string& text) {
    const int delay = patch.object("delay " + std::to_string(milliseconds)),
              box = patch.message(text);
    patch.connect(begin, 0, delay);
    patch.connect(delay, 0, box);
    return box;
  };
  later(0, "; pd open " + example + ".pd " + folder);
  later(10, "; pd dsp 1");
  for (const Told& told : messages) later(told.at, "; ex-" + told.text);
  later(1000 * from, "; heard bang");
  const int write =
      later(1000 * to + 50, "write -wave -bytes 4 " + folder + "/heard.wav heard-left heard-right");
  patch.connect(write, 0, patch.object("soundfiler"));
  patch.quit_after(1000 * to + 100);
  RunOptions options;
  if (live) options.meanwhile = [](const PdRun&) {};
  const PdRun run = run_pd(patch, options);
  Sound sound;
  sound.log = run.log;
  sound.errors = run.errors();
  read_wave(folder + "/heard.wav", sound);
  return sound;
}

void expect_sound(const Sound& sound, const std::string& what) {
  EXPECT_EQ(sound.errors, std::vector<std::string>()) << what << sound.log;
  ASSERT_GT(sound.left.size(), 100u) << what << sound.log;
  EXPECT_LT(sound.peak(), 1) << what;
  EXPECT_GT(sound.level(), 0.003) << what;
  EXPECT_LT(std::abs(sound.mean()), 0.001) << what;
  EXPECT_LT(sound.jump(), 0.6 * sound.peak()) << what;
}

// Of brightness, level or onsets, whichever differs most; as a logarithm of their ratio.
double difference(const Sound& a, const Sound& b) {
  return std::max({std::abs(std::log(a.brightness() / b.brightness())),
                   std::abs(std::log(a.level() / b.level())),
                   std::abs(std::log(a.onsets() / b.onsets()))});
}

TEST(Examples, sound_when_they_walk_and_are_silent_before) {
  GAIT_NEEDS_PD();
  for (const std::string example :
       {"street", "perpetual-walker", "speed-walker", "reconstruct-legs", "walk-to-sound"}) {
    expect_sound(play(example, {{50, "walk-in 1"}, {50, "level-in 1"}}, 1, 7), example);
    EXPECT_LT(play(example, {{50, "walk-in 1"}}, 1, 3).peak(), 1e-6)
        << example << " without a level";
  }
}

TEST(Examples, live_osc_sounds_when_it_hears_a_walk_over_the_network) {
  GAIT_NEEDS_PD();
  if (!fs::exists(GAIT_PD_FOLDER "/gait.osc.pd_linux")) GTEST_SKIP() << "built without liblo";
  const std::string port = std::to_string(20000 + getpid() % 20000);
  expect_sound(
      play("live-osc", {{20, "port-in " + port}, {50, "rehearse-in 1"}, {50, "level-in 1"}}, 1.5, 5,
           true),
      "live-osc");
  EXPECT_LT(play("live-osc", {{20, "port-in " + port}, {50, "listen-in 1"}, {50, "level-in 1"}},
                 0.5, 1.5, true)
                .peak(),
            1e-6)
      << "nobody walks";
}

TEST(Examples, perpetual_walker_keeps_and_recalls_presets) {
  GAIT_NEEDS_PD();
  const auto walked = [](std::vector<Told> messages) {
    messages.insert(messages.end(), {{60, "walk-in 1"}, {60, "level-in 1"}});
    return play("perpetual-walker", messages, 1, 5);
  };
  const Sound first = walked({{50, "recall1 bang"}}), second = walked({{50, "recall2 bang"}}),
              kept = walked({{20, "recall2 bang"},
                             {30, "store4 bang"},
                             {40, "recall1 bang"},
                             {50, "recall4 bang"}});
  for (const Sound* sound : {&first, &second, &kept}) expect_sound(*sound, "preset");
  EXPECT_GT(difference(first, second), std::log(1.1));
  EXPECT_LT(difference(kept, second), std::log(1.1));
}

TEST(Examples, walk_to_sound_has_a_sound_for_each_style) {
  GAIT_NEEDS_PD();
  constexpr int styles = 11;
  std::vector<Sound> sounds;
  for (int style = 0; style < styles; ++style) {
    const Sound sound = play(
        "walk-to-sound",
        {{40, "who" + std::to_string(style) + "-in bang"}, {50, "walk-in 1"}, {50, "level-in 1"}},
        2, 10);
    expect_sound(sound, "style " + std::to_string(style));
    sounds.push_back(sound);
  }
  for (std::size_t a = 0; a < sounds.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GT(difference(sounds[a], sounds[b]), std::log(1.1)) << a << " and " << b;
}

TEST(Examples, walk_to_sound_goes_on_when_the_stream_is_cut) {
  GAIT_NEEDS_PD();
  const std::vector<Told> walking{{50, "walk-in 1"}, {50, "level-in 1"}};
  std::vector<Told> cut = walking;
  cut.push_back({3000, "flow-in 0"});
  const Sound kept = play("walk-to-sound", walking, 4, 8), lost = play("walk-to-sound", cut, 4, 8);
  expect_sound(lost, "cut");
  EXPECT_NEAR(lost.onsets(), kept.onsets(), 0.5 * kept.onsets());
}

TEST(Abstractions, a_slider_learns_a_controller_with_one_click) {
  GAIT_NEEDS_PD();
  Patch patch;
  patch.object("gait.learn slider 2 12");
  patch.record(patch.object("r slider"), 0, "slider");
  const int begin = patch.object("loadbang"), first = patch.object("delay 10");
  patch.connect(begin, 0, first);
  patch.connect(first, 0,
                patch.message("; #ctlin 20 64 1; slider-learn 1; #ctlin 21 0 1; #ctlin 20 64 1; "
                              "#ctlin 21 127 2; #ctlin 21 127 1; slider-learn 1; slider-learn 0; "
                              "#ctlin 21 64 1"));
  patch.quit_after(50);
  const PdRun run = run_pd(patch);
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  EXPECT_EQ(run.recorded("slider"), std::vector<std::string>({"float 2", "float 12"})) << run.log;
}

TEST(Abstractions, a_pad_sends_where_its_dot_is) {
  GAIT_NEEDS_PD();
  Patch patch;
  const int pad = patch.object("gait.pad pad");
  patch.record(pad, 0, "pad");
  patch.at_start({"0.25 0.75", "; pad-x 1", "; pad-y 0"}, pad);
  patch.quit_after(50);
  const PdRun run = run_pd(patch);
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  EXPECT_EQ(run.recorded("pad"),
            std::vector<std::string>({"list 0.25 0.75", "list 1 0.75", "list 1 0"}))
      << run.log;
}

}  // namespace
}  // namespace gait::testing
