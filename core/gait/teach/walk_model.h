// A model of walking from captured walks: the labels right and left, which follow each other, and
// the spaces in which the style walker and the speed walker walk.
#pragma once

#include <string>

#include "gait/judge/model_selection.h"
#include "gait/learn/principal_components.h"
#include "gait/learn/walk_sequences.h"

namespace gait {

// What a model says of where it comes from.
struct ModelOrigin {
  std::string name = "walk";
  std::string date;        // free text, best as 2026-01-31T12:00:00Z
  std::string comment;     // a sentence for users of the model
  bool synthetic = false;  // the walks were computed, not captured
};

// Steps of walking, the default instance of labels: 0 right, 1 left, each followed by the other.
LearningTask walking_task(const WalkSequences& walks);

// Learns the model with its body, without spaces. Throws Error as select_model does.
Selected select_walk_model(const WalkSequences& walks, const SelectionOptions& options,
                           const ModelOrigin& origin = {});

// How finely cycles are kept. T10 has 40 frames and 23 components, which were 90 % of the variance
// of its walks; where styles lie further apart they take that share with five, and what tells a
// drunk walk from a heavy one is lost. Each component costs a frame of the walker some 30 ns.
struct StyleSpaceOptions {
  int frames = 40;  // even
  ComponentChoice components{.share = 0.999, .count = 0, .most = 64};
};

// Gives a model of walking the space of styles that the style walker needs, learnt from the same
// walks. Without styles, or with fewer than two straight cycles of any, the model stays without.
void add_style_space(Model& model, const std::vector<Walk>& walks,
                     const StyleSpaceOptions& options = {}, const RoleTable& roles = {});

struct LearntWalks {
  WalkSequences sequences;
  Selected selected;
};

// Learns a whole model: steps from `walks`, choosing by cross-validation what `selection` leaves
// open; the space of styles from the same walks; speed spaces from those of `over_speed` that
// walks_over_speed keeps (it may be `walks` again, or empty). Throws Error as walk_sequences and
// select_model do, and Error("cancelled").
LearntWalks learn_walks(const std::vector<Walk>& walks, const std::vector<Walk>& over_speed,
                        const WalkOptions& options, const SelectionOptions& selection,
                        const ModelOrigin& origin);

}  // namespace gait
