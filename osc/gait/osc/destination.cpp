#include "gait/osc/destination.h"

#include "gait/error.h"

namespace gait::osc {

Destination::Destination(const std::string& host, int port)
    : name_((host.find(':') == std::string::npos ? host : "[" + host + "]") + ":" +
            std::to_string(port)) {
  if (port < 1 || port > 65535)
    throw Error(name_ + ": expected a port from 1 to 65535, got " + std::to_string(port));
  std::string reason;
  for (const UdpAddress& to : addresses_of(host, port, name_)) {
    try {
      ways_.emplace_back(to);
    } catch (const Error& error) {
      reason = error.what();
    }
  }
  if (ways_.empty()) throw Error(name_ + ": " + reason);
}

bool Destination::send(std::span<const std::byte> bytes) const noexcept {
  bool refused = false;
  for (std::size_t tries = 0; tries < 2 * ways_.size(); ++tries) {
    const std::size_t at = current_.load(std::memory_order_relaxed) % ways_.size();
    switch (ways_[at].send(bytes)) {
      case Sent::yes:
        return true;
      case Sent::no:
        return false;
      case Sent::refused:
        refused = true;
        break;
      case Sent::unreachable:
        break;
    }
    current_.store(at + 1, std::memory_order_relaxed);
  }
  return refused;
}

}  // namespace gait::osc
