// [gait.map NAME]: maps the style of an observation onto the model's outputs (T14 §4.2).
#include <algorithm>

#include "gait/play/map/observation_map.h"
#include "gait/play/map/observation_message.h"
#include "objects.h"
#include "pd/model_player.h"
#include "pd/named_argument.h"

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
    join(info_);
  }

  void obs(const Arguments& arguments) {
    if (!ready_for_frame()) return;
    if (const char* wrong = map(arguments)) {
      slow_error().say([&] {
        return std::string("obs: ") + wrong + ", got " + std::to_string(arguments.size()) +
               " numbers";
      });
      perf().drop();
      return;
    }
    // Messages sent may come back and change what plays here: this one stays until all are sent.
    const std::shared_ptr<Mapping> mapping = playing();
    const ObservationMap& mapped = mapping->map;
    info_.add(mapped.distance()).send("distance");
    gauss_.add(mapping->message.lag()).add(mapped.model().output.values);
    gauss_.add(mapped.mean()).add(mapped.variance()).send("gauss");
  }

  void strength(const Arguments& arguments) {
    arguments.expect_count(1, 2);
    set(arguments, {arguments.size() == 1 ? Setting::strength : Setting::stream_strength,
                    "",
                    {static_cast<float>(arguments.number(arguments.size() - 1, -10, 10))}});
  }
  void bias(const Arguments& arguments) {
    if (arguments.size() < 2) arguments.fail("expected an output and what to add to its values");
    Setting bias{Setting::stream_bias, "", {}};
    for (int i = 1; i < arguments.size(); ++i)
      bias.values.push_back(static_cast<float>(arguments.number(i)));
    set(arguments, std::move(bias));
  }
  void spread(const Arguments& arguments) {
    const double spread = arguments.only().number(0, 0, 1000);
    if (spread == 0) arguments.fail_at(0, "a number above 0");
    set(arguments, {Setting::spread, "", {static_cast<float>(spread)}});
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
    // The map's own values, so that settings which later ones have overwritten are left out.
    const float common = map.streams() > 0 ? map.strength(0) : 1.0f;
    info_.add(common).send("strength");
    for (int stream = 0; stream < map.streams(); ++stream) {
      if (map.strength(stream) != common)
        tell({Setting::stream_strength, std::to_string(stream), {map.strength(stream)}});
      const std::span<const float> bias = map.bias(stream);
      if (std::ranges::any_of(bias, [](float value) { return value != 0; }))
        tell({Setting::stream_bias, std::to_string(stream), {bias.begin(), bias.end()}});
    }
    tell({Setting::spread, "", {map.spread()}});
  }

 private:
  // A setting as its message said it, for the maps of models to come.
  struct Setting {
    enum Kind { strength, stream_strength, stream_bias, spread } kind;
    std::string output;  // name or number; empty: all
    std::vector<float> values;
  };
  static constexpr const char* words[] = {"strength", "strength", "bias", "spread"};

  void describe() override {
    const ObservationMap& map = playing()->map;
    post("%s: maps with %s onto %d outputs, strength of the first %g, spread %g", box().name(),
         model_name().c_str(), map.streams(),
         map.streams() > 0 ? static_cast<double>(map.strength(0)) : 1.0,
         static_cast<double>(map.spread()));
  }
  Make make() override {
    return [](const SharedModel& model) { return std::make_shared<Mapping>(*model); };
  }

  void take(const SharedModel& model, Mapping& fresh) override {
    std::erase_if(settings_, [&](const Setting& setting) {
      if (apply(fresh.map, index_said(model->model->outputs, setting.output), setting))
        return false;
      complain(box(), std::string(words[setting.kind]) + ": no such output as '" + setting.output +
                          "' in " + model_name());
      return true;
    });
    gauss_.reserve(2 + 6 * model->model->output.values);
  }

  // Null, or why the message does not fit.
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

  // Keeps a setting, and gives it to the map when there is one.
  void set(const Arguments& arguments, Setting setting) {
    if (setting.kind == Setting::stream_strength || setting.kind == Setting::stream_bias) {
      setting.output = arguments.text(0);
      if (!model() && arguments.is_number(0)) arguments.integer(0, 0, 100000);
    }
    if (model()) {
      const std::vector<Stream>& outputs = model()->model->outputs;
      const int stream =
          setting.output.empty() ? -1 : named_argument(arguments, 0, outputs, "output");
      if (!apply(playing()->map, stream, setting))
        arguments.fail("expected " +
                       std::to_string(outputs[static_cast<std::size_t>(stream)].size) +
                       " finite numbers after the output");
    }
    std::erase_if(settings_, [&](const Setting& old) {
      return setting.kind == Setting::strength
                 ? old.kind == Setting::strength || old.kind == Setting::stream_strength
                 : old.kind == setting.kind && old.output == setting.output;
    });
    settings_.push_back(std::move(setting));
  }

  // False when the map has no such output, or one of another size.
  static bool apply(ObservationMap& map, int stream, const Setting& setting) {
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
    if (!setting.output.empty()) info_.add_text(setting.output);
    info_.add(std::span<const float>(setting.values)).send(words[setting.kind]);
  }

  Outlet gauss_, info_;
  std::vector<Setting> settings_;
};

}  // namespace

void setup_map() {
  Class<Map>("gait.map")
      .messages<&Map::obs, &Map::strength, &Map::bias, &Map::spread, &Map::through, &Map::through,
                &Map::through>({"obs", "strength", "bias", "spread", "stream", "walking", "place"})
      .common()
      .refuse_others();
}

}  // namespace gait::pd
