#include "gait/corpus/demo_model.h"

#include "gait/corpus/corpus.h"
#include "gait/model/model_file.h"
#include "gait/platform/path_text.h"
#include "gait/teach/walk_model.h"

namespace gait {

namespace {

// Cross-validation on the corpus chooses these. They are fixed, so that learning takes a second.
constexpr double regularisation = 10;
constexpr int rounds = 0;
// Sensors sit a degree or two off, and so is a performer's calibration pose. The synthetic walks
// come from one body without such errors: the option makes the model expect them.
constexpr double placement = 0.02;  // radians

}  // namespace

Model make_demo_model(int threads) {
  std::vector<Walk> walks;
  for (CorpusWalk& walk : make_corpus())
    walks.push_back({std::move(walk.clip), walk.style, {}, {}, std::move(walk.contacts)});
  std::vector<Walk> over_speed;
  for (CorpusWalk& walk : make_speed_walks())
    over_speed.push_back({std::move(walk.clip), {}, walk.subject, {}, std::move(walk.contacts)});
  SelectionOptions options;
  options.regularisation = regularisation;
  options.rounds = rounds;
  options.learning.hmm.threads = threads;
  options.learning.placement = placement;
  ModelOrigin origin;
  origin.name = demo_model_name;
  origin.comment = corpus_notice;
  origin.synthetic = true;
  return learn_walks(walks, over_speed, {}, options, origin).selected.model;
}

Model model_named(const std::string& name_or_path) {
  return name_or_path == demo_model_name ? make_demo_model()
                                         : read_model(path_from_utf8(name_or_path));
}

}  // namespace gait
