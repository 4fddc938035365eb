#include "pd/multichannel.h"

#include "gait/platform/host_process.h"

namespace gait::pd {

namespace {

using SetMultiOut = void (*)(t_signal**, int);

SetMultiOut set_multi_out() {
  static const auto found = reinterpret_cast<SetMultiOut>(program_function("signal_setmultiout"));
  return found;
}

}  // namespace

bool has_multichannel() { return set_multi_out() != nullptr; }

int channels_of(const t_signal* signal) {
  // Newer Pds keep it behind the sample rate, where 0.53, whose header may be the one used here,
  // counts references.
  return has_multichannel() ? *reinterpret_cast<const int*>(&signal->s_sr + 1) : 1;
}

void make_single(t_signal** signal) {
  if (has_multichannel()) set_multi_out()(signal, 1);
}

}  // namespace gait::pd
