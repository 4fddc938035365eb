// The library's entries. `gait_setup` registers everything; a single object's own set-up, by which
// Pd loads it when it is reached through a link of the object's name, does the same, so that all
// objects live in one copy of the library and share its models.
#include <m_pd.h>

#include "objects.h"

// One module for each size of Pd's numbers: Pd refuses the other.
#ifdef PD_FLOATSIZE
static_assert(8 * sizeof(t_float) == PD_FLOATSIZE && sizeof(t_sample) == sizeof(t_float));
#else
static_assert(sizeof(t_float) == 4 && sizeof(t_sample) == 4);
#endif

namespace {

void setup_all() {
  using namespace gait::pd;
  setup_bvh();
  setup_map();
  setup_model();
#ifdef GAIT_HAS_OSC
  setup_osc();
#endif
  setup_pca();
  setup_phase();
  setup_train();
  setup_viterbi();
  setup_synth();
  setup_skeleton();
}

}  // namespace

#define GAIT_ENTRY(name)                                         \
  extern "C" __attribute__((visibility("default"))) void name(); \
  void name() { setup_all(); }

GAIT_ENTRY(gait_setup)
GAIT_ENTRY(setup_gait0x2emodel)
GAIT_ENTRY(setup_gait0x2ebvh)
GAIT_ENTRY(setup_gait0x2eviterbi_tilde)
GAIT_ENTRY(setup_gait0x2emap)
GAIT_ENTRY(setup_gait0x2esynth)
GAIT_ENTRY(setup_gait0x2epca)
GAIT_ENTRY(setup_gait0x2ephase_tilde)
GAIT_ENTRY(setup_gait0x2eskeleton)
GAIT_ENTRY(setup_gait0x2etrain)
#ifdef GAIT_HAS_OSC
GAIT_ENTRY(setup_gait0x2eosc)
#endif
