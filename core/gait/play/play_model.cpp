#include "gait/play/play_model.h"

#include <mutex>
#include <utility>

#include "gait/error.h"
#include "gait/play/cycles/speed_tables.h"
#include "gait/play/cycles/style_tables.h"
#include "gait/play/recognise/state_tables.h"
#include "gait/play/synthesise/step_tables.h"

namespace gait {

struct PlayModel::Tables {
  std::mutex making;
  std::shared_ptr<const StateTables> states;
  std::shared_ptr<const StepTables> steps;
  std::shared_ptr<const StyleTables> styles;
  std::shared_ptr<const SpeedTables> speeds;

  template <class Table, class Make>
  std::shared_ptr<const Table> once(std::shared_ptr<const Table>& table, Make make) {
    const std::lock_guard lock(making);
    if (!table) table = make();
    return table;
  }
};

PlayModel::PlayModel(std::shared_ptr<const Model> played)
    : model(std::move(played)), tables_(std::make_shared<Tables>()) {}

std::shared_ptr<const StateTables> PlayModel::states() const {
  return tables_->once(tables_->states, [this] { return make_state_tables(*model); });
}

std::shared_ptr<const StepTables> PlayModel::steps() const {
  return tables_->once(tables_->steps, [this] { return make_step_tables(*model); });
}

std::shared_ptr<const StyleTables> PlayModel::styles() const {
  return tables_->once(tables_->styles, [this] { return make_style_tables(*model); });
}

std::shared_ptr<const SpeedTables> PlayModel::speeds() const {
  return tables_->once(tables_->speeds, [this] { return make_speed_tables(*model); });
}

std::shared_ptr<const PlayModel> make_play_model(Model model) {
  auto made = std::make_shared<const PlayModel>(std::make_shared<const Model>(std::move(model)));
  made->states();
  if (made->has_steps()) made->steps();
  if (made->has_cycles()) made->styles();
  if (made->has_speeds()) made->speeds();
  return made;
}

}  // namespace gait
