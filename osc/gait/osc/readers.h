// The readers of the forms, each in a file of its name.
#pragma once

#include <memory>

#include "gait/osc/form_reader.h"

namespace gait::osc {

Reading read_vmc(const OscMessage& message, const Arrival& arrival, EventSink& sink);
Reading read_neuron(const OscMessage& message, const Arrival& arrival, EventSink& sink);
Reading read_kinect(const OscMessage& message, const Arrival& arrival, EventSink& sink);
Reading read_gait(const OscMessage& message, const Arrival& arrival, EventSink& sink);
std::unique_ptr<FormReader> natnet_reader();

}  // namespace gait::osc
