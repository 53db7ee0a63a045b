#include "transport/multicast_socket.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "common/problem.hpp"
#include "controller/rt/clock.hpp"
#include "transport/lcm_packet.hpp"

namespace levitas::transport {

namespace {

constexpr int kReceiveBuffer = 4 << 20;  // [byte] 0.4 s of frames of 10 kHz and 1 kB each
constexpr std::int64_t kShortWaitNs = 25'000;
constexpr std::uint32_t kGiveUpSpins = 8;   // in a row without a message
constexpr std::uint32_t kRetryEvery = 256;  // waits; then a spin is tried again

[[noreturn]] void Fail(int socket, const LcmNetwork& network, Direction direction,
                       const char* what) {
  const int error = errno;
  if (socket >= 0) close(socket);
  const bool no_route = error == ENETUNREACH || error == ENODEV || error == EADDRNOTAVAIL;
  throw Problem(
      ExitStatus::kOther,
      fmt::format("multicast at {}: {}: {}{}", network.Url(direction), what, std::strerror(error),
                  no_route ? "; no route for multicast, give it one: "
                             "ip link set lo up; ip route add 224.0.0.0/4 dev lo"
                           : ""));
}

sockaddr_in Address(const LcmNetwork& network, Direction direction) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(network.Port(direction));
  inet_pton(AF_INET, network.group.c_str(), &address.sin_addr);
  return address;
}

const sockaddr* Generic(const sockaddr_in& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

template <class T>
bool Set(int socket, int level, int option, const T& value) {
  return setsockopt(socket, level, option, &value, sizeof(value)) == 0;
}

}  // namespace

MulticastSender::MulticastSender(const LcmNetwork& network, Direction direction) {
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0) Fail(socket_, network, direction, "socket");
  // Loop back: the partner is normally on this machine.
  if (!Set(socket_, IPPROTO_IP, IP_MULTICAST_LOOP, std::uint8_t{1}) ||
      !Set(socket_, IPPROTO_IP, IP_MULTICAST_TTL, static_cast<std::uint8_t>(network.ttl))) {
    Fail(socket_, network, direction, "setsockopt");
  }
  // A connected socket looks its route up once instead of with every datagram.
  const sockaddr_in group = Address(network, direction);
  if (connect(socket_, Generic(group), sizeof(group)) != 0) {
    Fail(socket_, network, direction, "connect");
  }
}

MulticastSender::~MulticastSender() { close(socket_); }

bool MulticastSender::Send(std::span<const std::uint8_t> datagram) noexcept {
  const auto sent = send(socket_, datagram.data(), datagram.size(), MSG_NOSIGNAL);
  return sent == static_cast<ssize_t>(datagram.size());
}

MulticastReceiver::MulticastReceiver(const LcmNetwork& network, Direction direction,
                                     std::int64_t spin_ns)
    : spin_ns_(spin_ns), buffer_(kMaxDatagram) {
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0) Fail(socket_, network, direction, "socket");
  // Several listeners share the port: lcm-logger may listen beside the controller. Bound to the
  // group, not to any address, so that other groups on the same port stay outside.
  const sockaddr_in group = Address(network, direction);
  Set(socket_, SOL_SOCKET, SO_RCVBUF, kReceiveBuffer);
  if (!Set(socket_, SOL_SOCKET, SO_REUSEADDR, int{1})) {
    Fail(socket_, network, direction, "setsockopt");
  }
  if (bind(socket_, Generic(group), sizeof(group)) != 0) Fail(socket_, network, direction, "bind");
  ip_mreq membership{};
  membership.imr_multiaddr = group.sin_addr;
  membership.imr_interface.s_addr = htonl(INADDR_ANY);
  if (!Set(socket_, IPPROTO_IP, IP_ADD_MEMBERSHIP, membership)) {
    Fail(socket_, network, direction, "join the group");
  }
}

MulticastReceiver::~MulticastReceiver() { close(socket_); }

Received MulticastReceiver::Poll() noexcept {
  sockaddr_in from{};
  socklen_t from_size = sizeof(from);
  const auto size = recvfrom(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT,
                             reinterpret_cast<sockaddr*>(&from), &from_size);
  if (size <= 0) return {};
  return {{buffer_.data(), static_cast<std::size_t>(size)},
          (std::uint64_t{from.sin_addr.s_addr} << 16) | from.sin_port};
}

Received MulticastReceiver::Spin(std::int64_t until_ns) noexcept {
  do {
    if (const Received received = Poll(); !received.datagram.empty()) return received;
  } while (rt::MonotonicNowNs() < until_ns);
  return {};
}

Received MulticastReceiver::Receive(std::int64_t deadline_ns) noexcept {
  if (const Received received = Poll(); !received.datagram.empty()) return received;
  std::int64_t now_ns = rt::MonotonicNowNs();
  if (now_ns >= deadline_ns) return {};
  // A sleep costs more than this; and a sleeping receiver costs its sender the wake-up.
  if (deadline_ns - now_ns <= kShortWaitNs) return Spin(deadline_ns);
  // Spinning helps while the partner runs on another core and answers at once. On a shared core it
  // keeps the partner from answering, so it is dropped while it brings nothing.
  if (spin_ns_ > 0 && (fruitless_spins_ < kGiveUpSpins || ++waits_ % kRetryEvery == 0)) {
    const Received received = Spin(std::min(deadline_ns, now_ns + spin_ns_));
    fruitless_spins_ = received.datagram.empty() ? fruitless_spins_ + 1 : 0;
    if (!received.datagram.empty()) return received;
    now_ns = rt::MonotonicNowNs();
  }
  while (now_ns < deadline_ns) {
    const std::int64_t left_ns = deadline_ns - now_ns;
    const timespec left{static_cast<time_t>(left_ns / 1'000'000'000),
                        static_cast<long>(left_ns % 1'000'000'000)};
    pollfd readable{socket_, POLLIN, 0};
    ppoll(&readable, 1, &left, nullptr);
    if (const Received received = Poll(); !received.datagram.empty()) return received;
    now_ns = rt::MonotonicNowNs();
  }
  return {};
}

}  // namespace levitas::transport
