#include "gait/osc/humanoid_sender.h"

#include "gait/error.h"
#include "gait/osc/forms.h"

namespace gait::osc {

HumanoidSender::HumanoidSender(MocapForm form, const std::vector<int>& bones) {
  if (form == MocapForm::none || !facts_of(form).packer)
    throw Error("expected one of " + form_names_text(true) + " to send a humanoid in, got " +
                std::string(form_name(form)));
  packer_ = facts_of(form).packer(bones);
}

}  // namespace gait::osc
