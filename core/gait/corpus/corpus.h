// The built-in corpus: synthetic walks of one 18-joint body in T10's eleven styles, with as many
// cycles of each as its Table 1, in several passages as an actor walking back and forth gives.
//
// Drawn from the mean human gait (mean_gait.h) and a list of changes per style (walk_styles.cpp).
// They are computed, not captured: a demonstration, and a source of exact truth for tests.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gait/corpus/synthetic_walk.h"
#include "gait/motion/clip.h"
#include "gait/motion/steps.h"

namespace gait {

// What to print wherever these walks are shown or a model made from them is named.
inline constexpr std::string_view corpus_notice =
    "synthetic walks: drawn from the mean human gait and a list of changes per style, not captured "
    "from anybody";

struct CorpusWalk {
  Clip clip;                      // metres, Y up, along +Z, ground at 0; name walk_STYLE_TAKE
  std::vector<Contact> contacts;  // first frame at or after the moment the foot meets the ground
  std::vector<double> phase;  // per frame, 0..1: 0 at right contact, 0.5 at left, linear between
  std::string style;
  int take = 1;         // from 1
  std::string subject;  // of walks over speed
  double speed = 0;     // m/s; 0: unknown
};

// The walk of a plan at any frame rate: the same motion, sampled from the same first moment.
CorpusWalk make_walk(const WalkPlan& plan, double frame_rate = 30);

// All walks of the corpus, style by style in corpus_styles' order, take by take. The same seed
// gives the same walks; another seed varies them as another day of the same actor would.
std::vector<CorpusWalk> make_corpus(std::uint64_t seed = 1, double frame_rate = 30);

// The neutral walk at 0.6, 0.8, ... 2.0 m/s, names walk_neutral_SPEED: one subject over speed (G04
// §2), of no style. Not part of the corpus of styles.
std::vector<CorpusWalk> make_speed_walks(std::uint64_t seed = 1, double frame_rate = 30);

// How many cycles each take of a style has: passages of four to six, together `cycles`.
std::vector<int> cycles_of_takes(int cycles);

// Writes each walk as a BVH file in units of `metres_per_unit`, and beside it an Audacity label
// file of its steps (walk_sad_3.txt). Makes the folder. Calls `progress` after each walk with the
// share done. Returns the paths of the BVH files. Throws Error when a file cannot be written.
std::vector<std::filesystem::path> write_corpus(const std::filesystem::path& folder,
                                                std::span<const CorpusWalk> walks,
                                                double metres_per_unit = 1,
                                                const std::function<void(double)>& progress = {});

}  // namespace gait
