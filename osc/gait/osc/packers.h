// The packers of the forms, each in the file FORM_packer.cpp or FORM_form.cpp.
#pragma once

#include <memory>
#include <vector>

#include "gait/osc/form_packer.h"

namespace gait::osc {

std::unique_ptr<FormPacker> vmc_packer(const std::vector<int>& bones);
std::unique_ptr<FormPacker> natnet_packer(const std::vector<int>& bones);
std::unique_ptr<FormPacker> neuron_packer(const std::vector<int>& bones);
std::unique_ptr<FormPacker> mocopi_packer(const std::vector<int>& bones);
std::unique_ptr<FormPacker> mvn_packer(const std::vector<int>& bones);
std::unique_ptr<FormPacker> rokoko_packer(const std::vector<int>& bones);
std::unique_ptr<FormPacker> mediapipe_packer(const std::vector<int>& bones);
std::unique_ptr<FormPacker> trackers_packer(const std::vector<int>& bones);

}  // namespace gait::osc
