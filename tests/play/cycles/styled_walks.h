// Models of walking in styles with all that the style walker needs, learnt once a program: from the
// built-in corpus, and from captured walks where they are; and what the walker walked, as clips.
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "gait/corpus/corpus.h"
#include "gait/files/bvh.h"
#include "gait/learn/trainer.h"
#include "gait/learn/walk_sequences.h"
#include "gait/model/body_pose.h"
#include "gait/motion/body_frame.h"
#include "gait/offline/walk_recorder.h"
#include "gait/play/cycles/style_walker.h"
#include "gait/teach/walk_model.h"
#include "shared_data.h"

namespace gait::testing {

struct StyledWalks {
  std::vector<Walk> walks;
  std::shared_ptr<const Model> model;
};

inline StyledWalks learnt_from(std::vector<Walk> walks) {
  const WalkSequences sequences = walk_sequences(walks, {});
  LearningOptions options;
  auto model = std::make_shared<Model>(learn(walking_task(sequences), options).model);
  model->body = sequences.body;
  add_style_space(*model, walks);
  return {std::move(walks), std::move(model)};
}

inline const StyledWalks& corpus_walks() {
  static const StyledWalks learnt = [] {
    std::vector<Walk> walks;
    for (CorpusWalk& walk : make_corpus())
      walks.push_back({std::move(walk.clip), walk.style, {}, {}, std::move(walk.contacts)});
    return learnt_from(std::move(walks));
  }();
  return learnt;
}

// bandai-namco-2: dataset-2_walk_STYLE_NNN.bvh
inline const StyledWalks& captured_walks() {
  static const StyledWalks learnt = [] {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(shared_data() / "bandai-namco-2"))
      if (entry.path().extension() == ".bvh") paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::vector<Walk> walks;
    for (const auto& path : paths) {
      const Clip clip = clip_from_bvh(read_bvh(path));
      Walk walk;
      walk.clip = in_metres_y_up(clip, guess_body_frame(clip, find_roles(clip.skeleton)));
      walk.clip.name = path.stem().string();
      const std::string name = walk.clip.name.substr(std::string("dataset-2_walk_").size());
      walk.style = name.substr(0, name.find('_'));
      walks.push_back(std::move(walk));
    }
    return learnt_from(std::move(walks));
  }();
  return learnt;
}

inline int style_named(const Model& model, const std::string& name) {
  const auto at = std::find(model.styles.begin(), model.styles.end(), name);
  return at == model.styles.end() ? -1 : static_cast<int>(at - model.styles.begin());
}

// What a walker walked, put on the ground as for whoever asks the tool for a walk.
struct Walked {
  Clip clip;
  std::vector<Contact> contacts;
  std::vector<double> phase;
};

template <typename EachFrame>
Walked walked(const Model& model, StyleWalker& walker, double frame_rate, int frames,
              EachFrame each_frame) {
  Walked result;
  WalkRecorder recorder(*model.body, frame_rate);
  for (int frame = 0; frame < frames; ++frame) {
    each_frame(frame);
    if (frame > 0) walker.advance(1 / frame_rate);
    if (walker.contact()) result.contacts.push_back({frame, *walker.contact()});
    result.phase.push_back(walker.phase());
    recorder.add(walker.pose());
  }
  result.clip = recorder.clip("walked");
  return result;
}

inline Walked walked(const Model& model, StyleWalker& walker, double frame_rate, int frames) {
  return walked(model, walker, frame_rate, frames, [](int) {});
}

}  // namespace gait::testing
