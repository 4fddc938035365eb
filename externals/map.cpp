// [gait.map NAME]: carries the style of what was observed over to the output (T14 §4.2).
#include <algorithm>

#include "gait/play/map/observation_map.h"
#include "gait/play/map/observation_message.h"
#include "objects.h"
#include "pd/model_player.h"
#include "pd/stream_argument.h"

namespace gait::pd {

namespace {

// What plays a model here.
struct Mapping {
  explicit Mapping(const PlayModel& model)
      : map(model), message(*model.model), row(static_cast<std::size_t>(message.longest())) {}
  ObservationMap map;
  ObservationMessage message;
  std::vector<float> row;
};

class Map final : public ModelPlayer<Mapping> {
 public:
  Map(Box& box, const Arguments& arguments)
      : ModelPlayer(box, arguments.size() > 0 ? arguments.text(0) : ""), gauss_(box), info_(box) {
    arguments.expect_count(0, 1);
    join();
  }

  void obs(const Arguments& arguments) {
    if (!ready_for_frame()) return;
    if (const char* wrong = map(arguments)) {
      slow_error().say([&] {
        return std::string(box().name()) + ": obs: " + wrong + ", got " +
               std::to_string(arguments.size()) + " numbers";
      });
      perf().drop();
      return;
    }
    const std::shared_ptr<Mapping> playing =
        this->playing();  // what is sent may come back and change it
    const ObservationMap& mapped = playing->map;
    info_.add(mapped.distance()).send("distance");
    gauss_.add(playing->message.lag()).add(mapped.model().output.values);
    gauss_.add(mapped.mean()).add(mapped.variance()).send("gauss");
  }

  void strength(const Arguments& arguments) {
    arguments.expect_count(1, 2);
    set(arguments, {arguments.size() == 1 ? Setting::strength : Setting::stream_strength,
                    -1,
                    {static_cast<float>(arguments.number(arguments.size() - 1, -10, 10))}});
  }
  void bias(const Arguments& arguments) {
    if (arguments.size() < 2) arguments.fail("expected an output and what to add to its values");
    Setting bias{Setting::stream_bias, -1, {}};
    for (int i = 1; i < arguments.size(); ++i)
      bias.values.push_back(static_cast<float>(arguments.number(i)));
    set(arguments, std::move(bias));
  }
  void spread(const Arguments& arguments) {
    arguments.expect_count(1);
    const double spread = arguments.number(0, 0, 1000);
    if (spread == 0) arguments.fail_at(0, "a number above 0");
    set(arguments, {Setting::spread, -1, {static_cast<float>(spread)}});
  }

  // To [gait.synth], as it came.
  void through(const Arguments& arguments) {
    gauss_.add(arguments.atoms()).send(arguments.selector().data());
  }

  void reset(const Arguments&) {}  // it remembers nothing but its settings
  void dump(const Arguments&) {
    if (!playing()) {
      for (const Setting& setting : settings_) tell(setting);
      return;
    }
    const ObservationMap& map = playing()->map;
    // All as the map has it, so that nothing is said that another setting has undone.
    const float common = map.streams() > 0 ? map.strength(0) : 1.0f;
    info_.add(common).send("strength");
    for (int stream = 0; stream < map.streams(); ++stream) {
      if (map.strength(stream) != common)
        tell({Setting::stream_strength, stream, {map.strength(stream)}});
      const std::span<const float> bias = map.bias(stream);
      if (std::ranges::any_of(bias, [](float value) { return value != 0; }))
        tell({Setting::stream_bias, stream, {bias.begin(), bias.end()}});
    }
    tell({Setting::spread, -1, {map.spread()}});
  }
  void report_perf(const Arguments&) { perf().report(info_); }
  void print(const Arguments&) {
    if (!playing()) {
      post("%s: waiting for %s", box().name(), model_name().c_str());
      return;
    }
    const ObservationMap& map = playing()->map;
    post("%s: maps with %s onto %d outputs, strength of the first %g, spread %g", box().name(),
         model_name().c_str(), map.streams(),
         map.streams() > 0 ? static_cast<double>(map.strength(0)) : 1.0,
         static_cast<double>(map.spread()));
  }

 private:
  // What was told, so that it can be told again to another model's map.
  struct Setting {
    enum Kind { strength, stream_strength, stream_bias, spread } kind;
    int stream;  // -1: all, or named below
    std::vector<float> values;
    std::string name{};  // of the stream; empty when it was told by number
  };
  static constexpr const char* words[] = {"strength", "strength", "bias", "spread"};

  Make make() override {
    return [](const SharedModel& model) { return std::make_shared<Mapping>(*model); };
  }

  void take(const SharedModel& model, Mapping& fresh) override {
    std::erase_if(settings_, [&](const Setting& setting) {
      if (apply(fresh.map, *model->model, setting)) return false;
      const std::string output =
          setting.name.empty() ? std::to_string(setting.stream) : setting.name;
      const std::string line = std::string(box().name()) + ": " + words[setting.kind] +
                               ": no such output as '" + output + "' in " + model_name();
      say_error(box(), line.c_str());
      return true;
    });
    gauss_.reserve(2 + 6 * model->model->output.values);
  }
  void say_ready() override { info_.add_text(model_name()).send("ready"); }

  // Null, or what was expected of the message.
  const char* map(const Arguments& arguments) noexcept {
    Perf::Frame frame(perf());
    const auto count = static_cast<std::size_t>(arguments.size());
    const std::span<float> row(playing()->row.data(), std::min(count, playing()->row.size()));
    const char* wrong = row.size() < count     ? "expected an observation of this model"
                        : !arguments.read(row) ? "expected numbers only"
                                               : playing()->message.read(row);
    if (wrong) {
      frame.forget();
      return wrong;
    }
    const ObservationMessage& message = playing()->message;
    playing()->map.map(message.states(), message.missing(), message.observation());
    return nullptr;
  }

  // Keeps a setting and lets it count at once; before the model is there it is kept.
  void set(const Arguments& arguments, Setting setting) {
    if (setting.kind == Setting::stream_strength || setting.kind == Setting::stream_bias) {
      if (model())
        setting.stream = stream_argument(arguments, 0, model()->model->outputs, "output");
      else if (arguments.is_number(0))
        setting.stream = arguments.integer(0, 0, 100000);
      if (arguments.is_symbol(0)) setting.name = arguments.symbol(0);
    }
    if (playing() && !apply(playing()->map, *model()->model, setting))
      arguments.fail("expected " + std::to_string(model()->model->outputs[setting.stream].size) +
                     " finite numbers after the output");
    std::erase_if(settings_, [&](const Setting& old) {
      return setting.kind == Setting::strength
                 ? old.kind == Setting::strength || old.kind == Setting::stream_strength
                 : old.kind == setting.kind && old.stream == setting.stream &&
                       old.name == setting.name;
    });
    settings_.push_back(std::move(setting));
  }

  // False when this model has no such output, or one of another size.
  static bool apply(ObservationMap& map, const Model& model, const Setting& setting) {
    int stream = setting.stream;
    if (!setting.name.empty()) {
      stream = -1;
      for (std::size_t i = 0; i < model.outputs.size(); ++i)
        if (model.outputs[i].name == setting.name) stream = static_cast<int>(i);
    }
    switch (setting.kind) {
      case Setting::strength:
        return map.set_strength(setting.values[0]);
      case Setting::stream_strength:
        return map.set_strength(stream, setting.values[0]);
      case Setting::stream_bias:
        return map.set_bias(stream, setting.values);
      default:
        return map.set_spread(setting.values[0]);
    }
  }

  void tell(const Setting& setting) {
    if (!setting.name.empty())
      info_.add(setting.name);
    else if (setting.stream >= 0)
      info_.add(setting.stream);
    info_.add(std::span<const float>(setting.values)).send(words[setting.kind]);
  }

  Outlet gauss_, info_;
  std::vector<Setting> settings_;
};

}  // namespace

void setup_map() {
  Class<Map>("gait.map")
      .message<&Map::obs>("obs")
      .message<&Map::strength>("strength")
      .message<&Map::bias>("bias")
      .message<&Map::spread>("spread")
      .message<&Map::through>("stream")
      .message<&Map::through>("walking")
      .message<&Map::through>("place")
      .common();
}

}  // namespace gait::pd
