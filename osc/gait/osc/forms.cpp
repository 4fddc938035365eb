#include "gait/osc/forms.h"

#include <algorithm>
#include <array>

#include "gait/osc/packers.h"
#include "gait/osc/readers.h"

namespace gait::osc {

namespace {

class MessageReader final : public FormReader {
 public:
  explicit MessageReader(ReadMessage how) : read_(how) {}
  Reading read(const OscMessage& message, const Arrival& arrival, EventSink& sink) override {
    return read_(message, arrival, sink);
  }

 private:
  ReadMessage read_;
};

template <ReadMessage how>
std::unique_ptr<FormReader> message_reader() {
  return std::make_unique<MessageReader>(how);
}

constexpr std::array forms{
    FormFacts{MocapForm::vmc, "vmc", FormSpace::unity, 39539, false,
              "the VMC protocol: avatars and what drives them", message_reader<read_vmc>,
              vmc_packer},
    FormFacts{MocapForm::natnet, "natnet", FormSpace::judged, 0, true,
              "NatNetThree2OSC, from OptiTrack Motive", natnet_reader, natnet_packer},
    FormFacts{MocapForm::neuron, "neuron", FormSpace::judged, 7432, false,
              "NeuronOSC, from Perception Neuron", message_reader<read_neuron>, neuron_packer},
    FormFacts{MocapForm::kinect, "kinect", FormSpace::camera, 7110, false, "OSCeleton and its kin",
              message_reader<read_kinect>, nullptr},
    FormFacts{MocapForm::mocopi, "mocopi", FormSpace::world, 12351, true, "Sony mocopi",
              mocopi_reader, mocopi_packer},
    FormFacts{MocapForm::mvn, "mvn", FormSpace::world, 9763, true, "Xsens MVN", mvn_reader,
              mvn_packer},
    FormFacts{MocapForm::rokoko, "rokoko", FormSpace::world, 14043, true, "Rokoko Studio",
              rokoko_reader, rokoko_packer},
    FormFacts{MocapForm::mediapipe, "mediapipe", FormSpace::world, 7500, true,
              "bridges of MediaPipe's landmarks", mediapipe_reader, mediapipe_packer},
    FormFacts{MocapForm::trackers, "trackers", FormSpace::world, 9000, false,
              "SlimeVR and VRChat: OSC trackers", trackers_reader, trackers_packer},
    FormFacts{MocapForm::phone, "phone", FormSpace::own, 3333, false,
              "phones: ZIG SIM, GyrOSC, TouchOSC, Sensors2OSC", phone_reader, nullptr},
    FormFacts{MocapForm::wekinator, "wekinator", FormSpace::own, 6448, false,
              "what sends inputs to Wekinator", message_reader<read_wekinator>, nullptr},
    FormFacts{MocapForm::gait, "gait", FormSpace::own, 0, false, "this project itself",
              message_reader<read_gait>, nullptr},
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < forms.size(); ++i)
    if (static_cast<std::size_t>(forms[i].form) != i + 1) return false;
  return true;
}
static_assert(in_order());

}  // namespace

std::span<const FormFacts> all_forms() { return forms; }

const FormFacts& facts_of(MocapForm form) { return forms[static_cast<std::size_t>(form) - 1]; }

std::string_view form_name(MocapForm form) {
  return form == MocapForm::none ? "none" : facts_of(form).name;
}

std::optional<MocapForm> form_named(std::string_view name) {
  const auto found = std::ranges::find(forms, name, &FormFacts::name);
  return found == forms.end() ? std::nullopt : std::optional(found->form);
}

bool is_sent(MocapForm form) { return form == MocapForm::gait || facts_of(form).packer; }

std::vector<std::string> form_names(bool sent) {
  std::vector<std::string> names;
  for (const FormFacts& facts : forms)
    if (!sent || is_sent(facts.form)) names.emplace_back(facts.name);
  return names;
}

std::string form_names_text(bool sent) {
  const std::vector<std::string> names = form_names(sent);
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  return text;
}

}  // namespace gait::osc
