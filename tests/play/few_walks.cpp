#include "play/few_walks.h"

namespace gait::testing {

WalkPlan plan_of(const std::string& style, int take, int cycles) {
  WalkPlan plan;
  plan.style = corpus_style(style);
  plan.take = take;
  plan.cycles = cycles;
  return plan;
}

Walk walk_of(const CorpusWalk& walk) {
  Walk result;
  result.clip = walk.clip;
  result.style = walk.style;
  result.contacts = walk.contacts;
  return result;
}

std::vector<Walk> few_walks() {
  std::vector<Walk> walks;
  for (const char* style : {"proud", "sad", "drunk", "in-a-hurry"})
    for (int take = 1; take <= 3; ++take) walks.push_back(walk_of(make_walk(plan_of(style, take))));
  return walks;
}

const WalkSequences& few_sequences() {
  static const WalkSequences sequences = walk_sequences(few_walks(), {});
  return sequences;
}

std::shared_ptr<const Model> few_walks_model() {
  static const std::shared_ptr<const Model> model = [] {
    LearningOptions options;
    options.states = 5;
    auto learnt = std::make_shared<Model>(learn(walking_task(few_sequences()), options).model);
    learnt->body = few_sequences().body;
    return learnt;
  }();
  return model;
}

InputPoses input_poses(const Clip& clip, const Body& body) {
  const std::vector<int> matched = match_joints(body, clip.skeleton, clip.name);
  InputPoses poses(clip.frames());
  for (int frame = 0; frame < clip.frames(); ++frame)
    for (const int joint : body.input_joints)
      poses[frame].push_back(clip.pose(frame)[matched[joint]].cast<float>());
  return poses;
}

Sequence streams_of(const CorpusWalk& walk, const Body& body) {
  const BodyPoses poses = body_poses(
      walk.clip, body, match_joints(body, walk.clip.skeleton, walk.clip.name), body.heading_window);
  return walk_sequence(body, poses, walk.contacts, walk.clip.name);
}

}  // namespace gait::testing
