#include "gait/osc/mocap_event.h"

namespace gait::osc {

namespace {

constexpr std::array<std::string_view, 6> names{"none",   "vmc",    "natnet",
                                                "neuron", "kinect", "gait"};

}  // namespace

std::string_view form_name(MocapForm form) { return names[static_cast<std::size_t>(form)]; }

std::optional<MocapForm> form_named(std::string_view name) {
  for (std::size_t i = 1; i < names.size(); ++i)
    if (names[i] == name) return static_cast<MocapForm>(i);
  return std::nullopt;
}

}  // namespace gait::osc
