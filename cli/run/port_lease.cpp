#include "cli/run/port_lease.hpp"

#include <fmt/core.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <string>
#include <utility>

#include "common/problem.hpp"

namespace levitas::cli {
namespace {

/// True when no socket of any program is bound to the UDP port: an exclusive bind succeeds.
bool Unused(std::uint16_t port) {
  const int probe = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (probe < 0) return false;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  sockaddr generic{};
  std::memcpy(&generic, &address, sizeof address);
  const bool unused = bind(probe, &generic, sizeof address) == 0;
  close(probe);
  return unused;
}

bool AllUnused(std::uint16_t base_port) {
  for (std::uint16_t i = 0; i < PortLease::kCount; ++i) {
    if (!Unused(static_cast<std::uint16_t>(base_port + i))) return false;
  }
  return true;
}

/// Holds "\0levitas-udp-<port>", or returns -1 when another process does.
int HoldName(std::uint16_t port) {
  const int held = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (held < 0) return -1;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = fmt::format("levitas-udp-{}", port);
  std::memcpy(&address.sun_path[1], name.data(), name.size());
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  if (bind(held, reinterpret_cast<const sockaddr*>(&address), size) != 0) {
    close(held);
    return -1;
  }
  return held;
}

}  // namespace

std::optional<PortLease> PortLease::TryHold(std::uint16_t base_port) {
  const int held = HoldName(base_port);
  if (held < 0) return std::nullopt;
  return PortLease(held, base_port);
}

PortLease PortLease::FirstFree(std::uint16_t first_base) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const auto base = static_cast<std::uint16_t>(first_base + attempt * kCount);
    std::optional<PortLease> lease = TryHold(base);
    if (lease && AllUnused(base)) return std::move(*lease);
  }
  throw Problem(ExitStatus::kOther,
                fmt::format("no four free UDP ports from {} to {}: end other runs, or name a base "
                            "port with --port lcm:udpm://239.255.76.67:PORT?ttl=0",
                            first_base, first_base + kAttempts * kCount - 1));
}

PortLease PortLease::Claim(std::uint16_t base_port) {
  std::optional<PortLease> lease = TryHold(base_port);
  if (lease) return std::move(*lease);
  throw Problem(ExitStatus::kUsage,
                fmt::format("UDP ports {} to {} belong to another run of this program; leave out "
                            "--port and a free set is taken",
                            base_port, base_port + kCount - 1));
}

PortLease::PortLease(PortLease&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), base_port_(other.base_port_) {}

PortLease::~PortLease() {
  if (socket_ >= 0) close(socket_);
}

}  // namespace levitas::cli
