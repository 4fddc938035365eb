// Forms: the one list of the forms in which live motion comes and goes, with what is known of each.
// A new form needs a value of MocapForm, a row of the table in forms.cpp, and its reader.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gait/osc/form_packer.h"
#include "gait/osc/form_reader.h"

namespace gait::osc {

// How a form's rotations and places are to be understood.
enum class FormSpace : std::uint8_t {
  own,     // the rig of the project's own form, or plain values: no humanoid
  unity,   // left-handed, each bone relative to its parent
  judged,  // right-handed; relative to the parent or in the world, which places tell
  world,   // right-handed, turns since the T-pose and places in the world
  camera   // places alone, whose axes' directions are found out
};

struct FormFacts {
  MocapForm form;
  std::string_view name;  // as users write it
  FormSpace space;
  int port;              // by custom; 0: none
  bool edges;            // a frame always ends with a message that says so
  std::string_view who;  // sends it
  std::unique_ptr<FormReader> (*reader)();
  // Packs humanoids; null where the form is only received. `bones`: parents first.
  std::unique_ptr<FormPacker> (*packer)(const std::vector<int>& bones);
};

std::span<const FormFacts> all_forms();
const FormFacts& facts_of(MocapForm form);  // not of `none`

std::string_view form_name(MocapForm form);  // "vmc"; "none"
std::optional<MocapForm> form_named(std::string_view name);
bool is_sent(MocapForm form);
// Names of the forms that are received, and of those that can be sent (`gait` among them).
std::vector<std::string> form_names(bool sent = false);
// "vmc, natnet or gait"
std::string form_names_text(bool sent = false);

}  // namespace gait::osc
