// A joint in a message: its name, or its number in the order of the model's joints; of a model of
// plain streams, a stream's.
#pragma once

#include <string>

#include "gait/model/model.h"
#include "pd/arguments.h"

namespace gait::pd {

// Of a model with a body: index into its joints. Throws Error naming what there is.
int joint_index(const Model& model, const Arguments& arguments, int i);

// Stream of all of a model's (inputs, then outputs) that belongs to a joint as said in a message.
// Throws Error when there is none, or the joint's rotation is neither input nor output.
int joint_stream(const Model& model, const Arguments& arguments, int i);

// The stream of that number: inputs first, then outputs.
const Stream& stream_at(const Model& model, int stream);

}  // namespace gait::pd
