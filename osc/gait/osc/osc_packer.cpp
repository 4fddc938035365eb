#include "gait/osc/osc_packer.h"

#include <algorithm>

namespace gait::osc {

void OscPacker::laid_out() {
  numbers_.resize(static_cast<std::size_t>(packets_.numbers()));
  for (const PacketTemplate& packet : packets_.packets())
    datagrams_.push_back({{packet.bytes().begin(), packet.bytes().end()}});
}

void OscPacker::end() noexcept {
  packets_.set(numbers_);
  for (std::size_t i = 0; i < datagrams_.size(); ++i)
    std::ranges::copy(packets_.packets()[i].bytes(), datagrams_[i].data.begin());
}

}  // namespace gait::osc
