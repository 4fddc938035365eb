// Streams that move no body, as plain numbers: what phones sense (ZIG SIM, GyrOSC, TouchOSC,
// Sensors2OSC) and inputs of Wekinator. Units are the sender's own.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "gait/osc/readers.h"

namespace gait::osc {

namespace {

constexpr int most_plain = 1024;  // values

// All numbers of a stream; a long one takes several events.
void tell_plain(MocapForm form, std::string_view name, int count, const auto& number_at,
                const Arrival& arrival, EventSink& sink) {
  MocapEvent event = event_of(MocapKind::plain, form, arrival);
  std::ranges::copy(name.substr(0, event.name.size() - 1), event.name.begin());
  event.total = static_cast<std::int16_t>(count);
  for (int first = 0; first < count; first += event.count) {
    event.first = static_cast<std::int16_t>(first);
    event.count = static_cast<std::int16_t>(
        std::min(static_cast<int>(MocapEvent::most_numbers), count - first));
    for (int i = 0; i < event.count; ++i)
      event.numbers[static_cast<std::size_t>(i)] = number_at(first + i);
    sink.take(event);
  }
}

Reading tell_message(MocapForm form, std::string_view name, const OscMessage& message,
                     const Arrival& arrival, EventSink& sink) {
  std::array<float, most_plain> numbers;
  if (message.size() < 1 || message.size() > most_plain ||
      !message.numbers(0, message.size(), numbers.data()))
    return Reading::faulty;
  tell_plain(
      form, name, message.size(), [&](int i) { return numbers[static_cast<std::size_t>(i)]; },
      arrival, sink);
  return Reading::taken;
}

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

class PhoneReader final : public FormReader {
 public:
  using FormReader::read;
  Reading read(const OscMessage& message, const Arrival& arrival, EventSink& sink) override {
    const std::string_view path = message.path();
    const std::size_t slash = path.rfind('/');
    const std::string_view name = path.substr(slash == std::string_view::npos ? 0 : slash + 1);
    const std::string_view owner = path.substr(0, path.size() - name.size());
    const auto parts = std::ranges::count(owner, '/');
    const bool known = owner == "/gyrosc/"
                           ? is_one_of(name, {"gyro", "rrate", "accel", "grav", "quat", "mag"})
                       : owner == "/"  // TouchOSC, Sensors2OSC, Control
                           ? is_one_of(name, {"accxyz", "accelerometer", "linearacceleration",
                                              "gravity", "gyroscope", "gyro", "rotationvector",
                                              "gamerotationvector", "orientation", "magneticfield"})
                           // ZIG SIM: /ZIGSIM/ID/NAME, or without its own name.
                           : owner.starts_with("/ZIGSIM/") || parts == 2
                                 ? is_one_of(name, {"accel", "gravity", "gyro", "quaternion"})
                                 : false;
    if (!known) return Reading::unknown;
    return tell_message(MocapForm::phone, name, message, arrival, sink);
  }

  // ZIG SIM's JSON.
  Reading read(std::span<const std::byte> datagram, const Arrival& arrival,
               EventSink& sink) override {
    if (datagram.empty() || datagram[0] != std::byte{'{'}) return Reading::unknown;
    const auto* text = reinterpret_cast<const char*>(datagram.data());
    const auto document = nlohmann::json::parse(text, text + datagram.size(), nullptr, false);
    if (!document.is_object() || !document.contains("sensordata")) return Reading::unknown;
    const auto& sensors = document["sensordata"];
    if (!sensors.is_object()) return Reading::faulty;
    for (const char* name : {"accel", "gravity", "gyro", "quaternion"}) {
      if (!sensors.contains(name)) continue;
      std::array<float, 4> numbers{};
      int count = 0;
      for (const char* axis : {"x", "y", "z", "w"}) {
        const auto& sensor = sensors[name];
        if (!sensor.is_object()) return Reading::faulty;
        if (!sensor.contains(axis)) break;
        if (!sensor[axis].is_number()) return Reading::faulty;
        const double number = sensor[axis].template get<double>();
        if (!(std::abs(number) < 1e6)) return Reading::faulty;
        numbers[static_cast<std::size_t>(count++)] = static_cast<float>(number);
      }
      if (count >= 3)
        tell_plain(
            MocapForm::phone, name, count,
            [&](int i) { return numbers[static_cast<std::size_t>(i)]; }, arrival, sink);
    }
    return Reading::taken;
  }
};

}  // namespace

std::unique_ptr<FormReader> phone_reader() { return std::make_unique<PhoneReader>(); }

Reading read_wekinator(const OscMessage& message, const Arrival& arrival, EventSink& sink) {
  if (message.path() != "/wek/inputs") return Reading::unknown;
  return tell_message(MocapForm::wekinator, "wek", message, arrival, sink);
}

}  // namespace gait::osc
