// A model with the tables that playing it needs.
//
// Each table is made when it is first asked for, and all copies of one PlayModel share it: several
// players of a model make its tables once, and one who only recognises makes no walker's tables.
// Any thread may ask.
#pragma once

#include <memory>

#include "gait/model/model.h"

namespace gait {

struct SpeedTables;
struct StateTables;
struct StepTables;
struct StyleTables;

class PlayModel {
 public:
  // Not explicit: wherever a model is to be played, the model alone will do.
  PlayModel(std::shared_ptr<const Model> played);

  std::shared_ptr<const Model> model;

  // Whether the model was learnt with what each kind of walker needs.
  bool has_steps() const { return model->input_mean.size() > 0; }
  bool has_cycles() const { return model->style_space.has_value(); }
  bool has_speeds() const { return !model->speed_spaces.empty(); }

  // Each throws Error when the model cannot serve, saying what it lacks.
  std::shared_ptr<const StateTables> states() const;  // for Recogniser and ObservationMap
  std::shared_ptr<const StepTables> steps() const;    // for StepWalker and Synthesiser
  std::shared_ptr<const StyleTables> styles() const;  // for StyleWalker
  std::shared_ptr<const SpeedTables> speeds() const;  // for SpeedWalker

 private:
  struct Tables;
  std::shared_ptr<Tables> tables_;
};

// Makes the tables at once, those of all walkers that the model can serve. Takes some milliseconds.
// Throws Error when the model cannot be played.
std::shared_ptr<const PlayModel> make_play_model(Model model);

}  // namespace gait
