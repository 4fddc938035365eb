// One per object: registers its class with Pd, unless it is registered already.
#pragma once

namespace gait::pd {

void setup_bvh();
void setup_map();
void setup_model();
void setup_osc();
void setup_pca();
void setup_phase();
void setup_train();
void setup_viterbi();
void setup_synth();
void setup_skeleton();

}  // namespace gait::pd
