#include "transport/multicast_options.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <net/if.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>

#include "common/problem.hpp"

namespace levitas::transport {

void Fail(int socket, const LcmNetwork& network, Direction direction, const char* what) {
  const int error = errno;
  if (socket >= 0) close(socket);
  const bool no_way = error == ENETUNREACH || error == ENODEV || error == EADDRNOTAVAIL;
  const char* remedy = network.this_machine_only()
                           ? "; the loopback interface is down: ip link set lo up"
                           : "; no route for multicast, name the interface of the rig's network: "
                             "ip route add 224.0.0.0/4 dev INTERFACE";
  throw Problem(ExitStatus::kOther, fmt::format("multicast at {}: {}: {}{}", network.Url(direction),
                                                what, std::strerror(error), no_way ? remedy : ""));
}

sockaddr_in Address(const LcmNetwork& network, Direction direction) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(network.Port(direction));
  inet_pton(AF_INET, network.group.c_str(), &address.sin_addr);
  return address;
}

const sockaddr* Generic(const sockaddr_in& address) noexcept {
  return reinterpret_cast<const sockaddr*>(&address);
}

std::int64_t UtcNowNs() noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

SealingKey KeyOf(const LcmNetwork& network, Direction direction) {
  return network.key->For(fmt::format("{}:{}", network.group, network.Port(direction)));
}

unsigned Loopback() noexcept { return if_nametoindex("lo"); }

ip_mreqn Interface(const LcmNetwork& network) noexcept {
  ip_mreqn request{};
  if (!network.this_machine_only()) return request;
  request.imr_address.s_addr = htonl(INADDR_LOOPBACK);
  request.imr_ifindex = static_cast<int>(Loopback());
  return request;
}

}  // namespace levitas::transport
