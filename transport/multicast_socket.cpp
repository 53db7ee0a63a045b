#include "transport/multicast_socket.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <vector>

#include "common/problem.hpp"
#include "controller/rt/clock.hpp"
#include "transport/lcm_packet.hpp"

namespace levitas::transport {

namespace {

constexpr std::size_t kBatch = 8;
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

// Storage for one recvmmsg: the newest frame is wanted, so all that is queued is fetched at once
// instead of one call each and a last one that finds nothing.
struct MulticastReceiver::Batch {
  Batch() : bytes(kBatch * kMaxDatagram) {
    for (std::size_t at = 0; at < kBatch; ++at) {
      pieces[at] = {bytes.data() + at * kMaxDatagram, kMaxDatagram};
      messages[at].msg_hdr.msg_iov = &pieces[at];
      messages[at].msg_hdr.msg_iovlen = 1;
      messages[at].msg_hdr.msg_name = &from[at];
    }
  }
  /// The next one that holds anything; an empty datagram says nothing.
  [[nodiscard]] Received Take() noexcept {
    while (taken < filled) {
      const std::size_t at = taken++;
      if (messages[at].msg_len == 0) continue;
      return {{bytes.data() + at * kMaxDatagram, messages[at].msg_len},
              (std::uint64_t{from[at].sin_addr.s_addr} << 16) | from[at].sin_port};
    }
    return {};
  }

  std::vector<std::uint8_t> bytes;
  std::array<iovec, kBatch> pieces{};
  std::array<sockaddr_in, kBatch> from{};
  std::array<mmsghdr, kBatch> messages{};
  std::size_t filled{0};
  std::size_t taken{0};
};

MulticastReceiver::MulticastReceiver(const LcmNetwork& network, Direction direction,
                                     std::int64_t spin_ns)
    : spin_ns_(spin_ns), batch_(std::make_unique<Batch>()) {
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
  Batch& batch = *batch_;
  for (auto& message : batch.messages) message.msg_hdr.msg_namelen = sizeof(sockaddr_in);
  const int count = recvmmsg(socket_, batch.messages.data(), kBatch, MSG_DONTWAIT, nullptr);
  batch.taken = 0;
  batch.filled = count > 0 ? static_cast<std::size_t>(count) : 0;
  return batch.Take();
}

Received MulticastReceiver::Next() noexcept {
  const Received received = batch_->Take();
  if (!received.datagram.empty() || batch_->filled < kBatch) return received;
  return Poll();
}

Received MulticastReceiver::Spin(std::int64_t until_ns) noexcept {
  do {
    if (const Received received = Poll(); !received.datagram.empty()) return received;
  } while (rt::MonotonicNowNs() < until_ns);
  return {};
}

Received MulticastReceiver::Receive(std::int64_t deadline_ns) noexcept {
  if (const Received queued = batch_->Take(); !queued.datagram.empty()) return queued;
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
