#include "gait/corpus/demo_model.h"

#include "gait/corpus/corpus.h"
#include "gait/model/model_file.h"
#include "gait/teach/walk_model.h"
#include "gait/teach/walks_over_speed.h"

namespace gait {

namespace {

// What cross-validation finds on the corpus, kept so that the model is there at once.
constexpr double regularisation = 10;
constexpr int rounds = 0;
// Nobody wears a suit, or stands for its calibration, to the degree; the walks are drawn from a
// single body that does.
constexpr double placement = 0.02;  // radians

}  // namespace

Model make_demo_model(int threads) {
  std::vector<Walk> walks;
  for (CorpusWalk& walk : make_corpus())
    walks.push_back({std::move(walk.clip), walk.style, {}, {}, std::move(walk.contacts)});
  SelectionOptions options;
  options.regularisation = regularisation;
  options.rounds = rounds;
  options.learning.hmm.threads = threads;
  options.learning.placement = placement;
  ModelOrigin origin;
  origin.name = demo_model_name;
  origin.comment = corpus_notice;
  origin.synthetic = true;
  Model model = select_walk_model(walk_sequences(walks, {}), options, origin).model;
  add_style_space(model, walks);

  std::vector<Walk> over_speed;
  for (CorpusWalk& walk : make_speed_walks())
    over_speed.push_back({std::move(walk.clip), {}, walk.subject, {}, std::move(walk.contacts)});
  add_speed_spaces(model, over_speed);
  return model;
}

Model model_named(const std::string& name_or_path) {
  return name_or_path == demo_model_name ? make_demo_model() : read_model(name_or_path);
}

}  // namespace gait
