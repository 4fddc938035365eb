// A small model of walking for tests: some takes of four of the built-in styles, learnt once a
// program; and built-in walks as the streams that a performer's sensors would send.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gait/corpus/corpus.h"
#include "gait/learn/trainer.h"
#include "gait/learn/walk_sequences.h"
#include "gait/model/body_pose.h"
#include "gait/teach/walk_model.h"

namespace gait::testing {

// A take of a style, of so many cycles.
WalkPlan plan_of(const std::string& style, int take, int cycles = 4);
Walk walk_of(const CorpusWalk& walk);

// Takes 1 to 3 of each style.
std::vector<Walk> few_walks();
const WalkSequences& few_sequences();
std::shared_ptr<const Model> few_walks_model();

using InputPoses = std::vector<std::vector<Eigen::Quaternionf>>;

// Frame after frame, the local rotations of the model's input joints.
InputPoses input_poses(const Clip& clip, const Body& body);

// A walk as a model's streams of values, as if it had been captured for learning.
Sequence streams_of(const CorpusWalk& walk, const Body& body);

}  // namespace gait::testing
