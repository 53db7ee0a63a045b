#pragma once
// Four consecutive UDP ports that no other run uses, held for as long as this object lives.
//
// Why       LCM tells networks apart by port only: two runs on the same ports would levitate each
//           other's rotors. Multicast sockets may share a port, so a bind does not reserve it.
// How       the lease is a name in the abstract socket namespace, which belongs to the network
//           namespace, as the ports do; the kernel drops it with the process, however that ends.
//           Ports that any other program has bound are passed over too.
// Failure   Problem (exit status 1) when nothing is free; Claim: exit status 2, naming the ports.
// Thread    any.

#include <cstdint>
#include <optional>

namespace levitas::cli {

class PortLease {
 public:
  static constexpr std::uint16_t kDefaultBase = 7667;  ///< LCM's own default: tools listen there
  static constexpr std::uint16_t kCount = 4;           ///< one per direction
  static constexpr int kAttempts = 256;                ///< bases tried, kCount apart

  /// The first free base from `first_base` on.
  static PortLease FirstFree(std::uint16_t first_base = kDefaultBase);
  /// Exactly this base; other programs may listen on it (lcm-spy), another run may not.
  static PortLease Claim(std::uint16_t base_port);

  ~PortLease();
  PortLease(PortLease&& other) noexcept;
  PortLease& operator=(PortLease&&) = delete;
  [[nodiscard]] std::uint16_t base_port() const noexcept { return base_port_; }

 private:
  PortLease(int socket, std::uint16_t base_port) noexcept
      : socket_(socket), base_port_(base_port) {}
  static std::optional<PortLease> TryHold(std::uint16_t base_port);

  int socket_{-1};
  std::uint16_t base_port_{};
};

}  // namespace levitas::cli
