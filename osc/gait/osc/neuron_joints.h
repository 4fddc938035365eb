// The joints of Perception Neuron, by the numbers that NeuronOSC gives them (read from
// github.com/fusefactory/ofxPerceptionNeuronOSC).
#pragma once

namespace gait::osc {

inline constexpr int neuron_joints = 59;

// A humanoid's bone of a joint, from 0 to neuron_joints - 1, and the joint of a bone; -1: none.
int neuron_bone(int joint);
int neuron_joint(int bone);

}  // namespace gait::osc
