// The readers of the forms, each in the file FORM_reader.cpp or FORM_form.cpp.
#pragma once

#include <memory>

#include "gait/osc/form_reader.h"

namespace gait::osc {

Reading read_vmc(const OscMessage& message, const Arrival& arrival, EventSink& sink);
Reading read_neuron(const OscMessage& message, const Arrival& arrival, EventSink& sink);
Reading read_kinect(const OscMessage& message, const Arrival& arrival, EventSink& sink);
Reading read_gait(const OscMessage& message, const Arrival& arrival, EventSink& sink);
Reading read_wekinator(const OscMessage& message, const Arrival& arrival, EventSink& sink);
std::unique_ptr<FormReader> natnet_reader();
std::unique_ptr<FormReader> mocopi_reader();
std::unique_ptr<FormReader> mvn_reader();
std::unique_ptr<FormReader> rokoko_reader();
std::unique_ptr<FormReader> mediapipe_reader();
std::unique_ptr<FormReader> trackers_reader();
std::unique_ptr<FormReader> phone_reader();

}  // namespace gait::osc
