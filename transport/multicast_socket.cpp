#include "transport/multicast_socket.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <linux/filter.h>
#include <net/if.h>
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

const sockaddr* Generic(const sockaddr_in& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

template <class T>
bool Set(int socket, int level, int option, const T& value) {
  return setsockopt(socket, level, option, &value, sizeof(value)) == 0;
}

unsigned Loopback() { return if_nametoindex("lo"); }

/// Which interface, as the socket options for multicast want it; without `loopback` the one of the
/// route to the group.
ip_mreqn Interface(bool loopback) {
  ip_mreqn request{};
  request.imr_address.s_addr = htonl(loopback ? INADDR_LOOPBACK : INADDR_ANY);
  request.imr_ifindex = loopback ? static_cast<int>(Loopback()) : 0;
  return request;
}

/// The interface a datagram came in through; 0 when the kernel did not say.
unsigned InterfaceOf(msghdr& header) noexcept {
  for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
    if (part->cmsg_level != IPPROTO_IP || part->cmsg_type != IP_PKTINFO) continue;
    in_pktinfo info{};
    std::memcpy(&info, CMSG_DATA(part), sizeof(info));
    return static_cast<unsigned>(info.ipi_ifindex);
  }
  return 0;
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
  // A time to live of 0 alone would leave the choice of the interface to the routes.
  if (network.this_machine_only() && !Set(socket_, IPPROTO_IP, IP_MULTICAST_IF, Interface(true))) {
    Fail(socket_, network, direction, "send on the loopback interface");
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

std::string AddressText(std::uint64_t sender) {
  constexpr std::uint64_t kPortBits = 16;
  const in_addr address{static_cast<in_addr_t>(sender >> kPortBits)};
  std::array<char, INET_ADDRSTRLEN> text{};
  inet_ntop(AF_INET, &address, text.data(), text.size());
  return fmt::format("{}:{}", text.data(), ntohs(static_cast<std::uint16_t>(sender)));
}

std::uint16_t MulticastSender::port() const noexcept {
  sockaddr_in own{};
  socklen_t size = sizeof(own);
  // The sockets' interface knows every address by this type.
  const bool known = getsockname(socket_, reinterpret_cast<sockaddr*>(&own), &size) == 0;
  return known ? ntohs(own.sin_port) : std::uint16_t{0};
}

// Storage for one recvmmsg: the newest frame is wanted, so all that is queued is fetched at once
// instead of one call each and a last one that finds nothing.
struct MulticastReceiver::Batch {
  explicit Batch(unsigned interface) : only_interface(interface), bytes(kBatch * kMaxDatagram) {
    for (std::size_t at = 0; at < kBatch; ++at) {
      pieces[at] = {bytes.data() + at * kMaxDatagram, kMaxDatagram};
      messages[at].msg_hdr.msg_iov = &pieces[at];
      messages[at].msg_hdr.msg_iovlen = 1;
      messages[at].msg_hdr.msg_name = &from[at];
      messages[at].msg_hdr.msg_control = about[at].bytes.data();
    }
  }
  void Fetch(int socket) noexcept {
    for (auto& message : messages) {
      message.msg_hdr.msg_namelen = sizeof(sockaddr_in);
      message.msg_hdr.msg_controllen = sizeof(About);
    }
    const int count = recvmmsg(socket, messages.data(), kBatch, MSG_DONTWAIT, nullptr);
    taken = 0;
    filled = count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  /// The next one that holds anything; an empty datagram says nothing.
  [[nodiscard]] Received Take() noexcept {
    while (taken < filled) {
      const std::size_t at = taken++;
      if (messages[at].msg_len == 0) continue;
      if (only_interface != 0 && InterfaceOf(messages[at].msg_hdr) != only_interface) {
        ++foreign;
        continue;
      }
      return {{bytes.data() + at * kMaxDatagram, messages[at].msg_len},
              (std::uint64_t{from[at].sin_addr.s_addr} << 16) | from[at].sin_port};
    }
    return {};
  }

  struct About {  ///< the kernel's word on one datagram
    alignas(cmsghdr) std::array<std::uint8_t, CMSG_SPACE(sizeof(in_pktinfo))> bytes{};
  };

  unsigned only_interface;  ///< 0: any
  std::uint64_t foreign{0};
  std::vector<std::uint8_t> bytes;
  std::array<About, kBatch> about{};
  std::array<iovec, kBatch> pieces{};
  std::array<sockaddr_in, kBatch> from{};
  std::array<mmsghdr, kBatch> messages{};
  std::size_t filled{0};
  std::size_t taken{0};
};

MulticastReceiver::MulticastReceiver(const LcmNetwork& network, Direction direction,
                                     std::int64_t spin_ns)
    : spin_ns_(spin_ns),
      batch_(std::make_unique<Batch>(network.this_machine_only() ? Loopback() : 0)) {
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
  // The kernel shall pass on only what came in through the interface joined below, not what any
  // other program's membership lets in; and it shall say which interface that was.
  if (!Set(socket_, IPPROTO_IP, IP_MULTICAST_ALL, int{0}) ||
      !Set(socket_, IPPROTO_IP, IP_PKTINFO, int{1})) {
    Fail(socket_, network, direction, "setsockopt");
  }
  ip_mreqn membership = Interface(network.this_machine_only());
  membership.imr_multiaddr = group.sin_addr;
  if (!Set(socket_, IPPROTO_IP, IP_ADD_MEMBERSHIP, membership)) {
    Fail(socket_, network, direction, "join the group");
  }
}

MulticastReceiver::~MulticastReceiver() { close(socket_); }

std::uint64_t MulticastReceiver::foreign() const noexcept { return batch_->foreign; }
bool MulticastReceiver::Filter(std::span<const sock_filter> program) noexcept {
  // The kernel's interface takes a pointer to what it only reads.
  std::vector<sock_filter> steps(program.begin(), program.end());
  const sock_fprog filter{static_cast<unsigned short>(steps.size()), steps.data()};
  return Set(socket_, SOL_SOCKET, SO_ATTACH_FILTER, filter);
}

Received MulticastReceiver::Poll() noexcept {
  batch_->Fetch(socket_);
  return batch_->Take();
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
