#include "gait/osc/destination.h"

#include "gait/error.h"

namespace gait::osc {

Destination::Destination(const std::string& host, int port) try
    : name_(host + ":" + std::to_string(port)) {
  if (port < 1 || port > 65535)
    throw Error("expected a port from 1 to 65535, got " + std::to_string(port));
  address_ = {find_host(host), static_cast<std::uint16_t>(port)};
} catch (const Error& error) {
  throw Error(host + ":" + std::to_string(port) + ": " + error.what());
}

bool Destination::send(std::span<const std::byte> bytes) const noexcept {
  return socket_.send(bytes, address_);
}

}  // namespace gait::osc
