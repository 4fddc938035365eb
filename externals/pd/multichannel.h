// Multichannel signals, on a Pd that has them (0.54 or later), from a library built for any.
#pragma once

#include <m_pd.h>

namespace gait::pd {

// To be given to Class for a class that takes multichannel signals; older Pds do not look at it.
inline constexpr int multichannel_class = 0x10;

bool has_multichannel();
// Channels of an inlet's signal: they follow each other in its vector. 1 on an older Pd.
int channels_of(const t_signal* signal);
// Of a class as above every signal outlet needs this in its dsp method: one channel.
void make_single(t_signal** signal);

}  // namespace gait::pd
