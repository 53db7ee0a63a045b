#pragma once
// What the two halves of multicast_socket.hpp share: addresses, socket options, failures, the clock
// of the seals.
//
// Thread   any. Failure: Fail throws Problem (exit status 1) with the remedy.

#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdint>

#include "transport/lcm_network.hpp"
#include "transport/network_key.hpp"

namespace levitas::transport {

/// Says what `errno` means for this network; closes the socket.
[[noreturn]] void Fail(int socket, const LcmNetwork& network, Direction direction,
                       const char* what);

[[nodiscard]] sockaddr_in Address(const LcmNetwork& network, Direction direction);
[[nodiscard]] const sockaddr* Generic(const sockaddr_in& address) noexcept;

/// Index of the loopback interface; 0 when there is none.
[[nodiscard]] unsigned Loopback() noexcept;
/// Which interface, as the socket options for multicast want it: loopback for a network of this
/// machine only, else the one of the route to the group.
[[nodiscard]] ip_mreqn Interface(const LcmNetwork& network) noexcept;

/// What the network's key is made into for one port of one group.
[[nodiscard]] SealingKey KeyOf(const LcmNetwork& network, Direction direction);
/// [ns] since 1970.
[[nodiscard]] std::int64_t UtcNowNs() noexcept;

template <class T>
bool Set(int socket, int level, int option, const T& value) noexcept {
  return setsockopt(socket, level, option, &value, sizeof(value)) == 0;
}

}  // namespace levitas::transport
