// The packers of the forms, each in a file of its name.
#pragma once

#include <memory>
#include <vector>

#include "gait/osc/form_packer.h"

namespace gait::osc {

std::unique_ptr<FormPacker> vmc_packer(const std::vector<int>& bones);
std::unique_ptr<FormPacker> natnet_packer(const std::vector<int>& bones);
std::unique_ptr<FormPacker> neuron_packer(const std::vector<int>& bones);

}  // namespace gait::osc
