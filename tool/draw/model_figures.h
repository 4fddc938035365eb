// The papers' figures of what a model holds: T10 fig. 2 to 4, G04 fig. 3 to 7.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "draw/chart.h"
#include "gait/model/model.h"

namespace gait::tool {

inline constexpr int shown_scores = 4;  // components that a figure of scores shows

// Each throws Error when the model has not what the figure shows, saying how to train one that has.

// Cumulated variance over components, a line per space (T10 fig. 2, G04 fig. 3).
Chart variance_figure(const Model& model);

// The first scores of each style's cycles: mean, deviation, range (T10 fig. 3).
Chart scores_figure(const Model& model);

// Durations and first scores of cycles that follow each other in walks of the style walker, style
// by style (T10 fig. 4).
Chart cycles_figure(const std::shared_ptr<const Model>& model, std::uint64_t seed);

// Scores over speed: standing, lines, and what lies beyond the captured speeds (G04 fig. 4 to 6).
// `subject`: in that subject's own space; empty: of all in the one they share.
Chart speed_figure(const Model& model, const std::string& subject);

// Cycles per second over speed, as captured and as the feet ask, with Inman's law (G04 fig. 7).
Chart frequency_figure(const std::shared_ptr<const Model>& model);

}  // namespace gait::tool
