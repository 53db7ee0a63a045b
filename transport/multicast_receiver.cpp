// The listening half of multicast_socket.hpp.

#include <arpa/inet.h>
#include <fmt/core.h>
#include <linux/filter.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <ctime>
#include <utility>
#include <vector>

#include "rt/clock.hpp"
#include "transport/lcm_packet.hpp"
#include "transport/multicast_options.hpp"
#include "transport/multicast_socket.hpp"
#include "transport/operator_message.hpp"
#include "transport/seal.hpp"

namespace levitas::transport {

namespace {

constexpr std::size_t kBatch = 8;
constexpr int kFruitlessBatches = 32;
constexpr int kReceiveBuffer = 4 << 20;  // [byte] 0.4 s of frames of 10 kHz and 1 kB each
constexpr std::int64_t kShortWaitNs = 25'000;
constexpr std::uint32_t kGiveUpSpins = 8;   // in a row without a message
constexpr std::uint32_t kRetryEvery = 256;  // waits; then a spin is tried again

constexpr std::array kRefusals{SealWord::kNone, SealWord::kVersion, SealWord::kWrongKey,
                               SealWord::kOld,  SealWord::kClock,   SealWord::kChallenge};

/// By the receiver's own challenge where commands arrive, else by time at first contact.
std::unique_ptr<SealCheck> Seals(const LcmNetwork& network, Direction direction) {
  if (!network.key) return nullptr;
  const bool commands = direction == Direction::kCommand;
  return std::make_unique<SealCheck>(KeyOf(network, direction),
                                     commands ? SealRule::kChallenge : SealRule::kClock,
                                     rt::MonotonicNowNs(), commands ? SealSuffices : nullptr);
}

std::string ClockText(const SealCheck& check) {
  return fmt::format(" ({:+.1f} s from this machine's clock)",
                     static_cast<double>(check.clock_off_ns()) * 1e-9);
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

std::string AddressText(std::uint64_t sender) {
  constexpr std::uint64_t kPortBits = 16;
  const in_addr address{static_cast<in_addr_t>(sender >> kPortBits)};
  std::array<char, INET_ADDRSTRLEN> text{};
  inet_ntop(AF_INET, &address, text.data(), text.size());
  return fmt::format("{}:{}", text.data(), ntohs(static_cast<std::uint16_t>(sender)));
}

// Storage for one recvmmsg: the newest frame is wanted, so all that is queued is fetched at once
// instead of one call each and a last one that finds nothing.
struct MulticastReceiver::Batch {
  Batch(unsigned interface, std::unique_ptr<SealCheck> seals)
      : only_interface(interface), seal_check(std::move(seals)), bytes(kBatch * kMaxDatagram) {
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
  [[nodiscard]] Received Take(bool unproven) noexcept {
    while (taken < filled) {
      const std::size_t at = taken++;
      if (messages[at].msg_len == 0) continue;
      if (only_interface != 0 && InterfaceOf(messages[at].msg_hdr) != only_interface) {
        foreign.store(foreign.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        continue;
      }
      Received received{{bytes.data() + at * kMaxDatagram, messages[at].msg_len},
                        (std::uint64_t{from[at].sin_addr.s_addr} << 16) | from[at].sin_port};
      received.identity = received.sender;
      if (seal_check && !Opens(received, unproven)) continue;
      if (!received.datagram.empty()) return received;
    }
    return {};
  }
  [[nodiscard]] bool Opens(Received& received, bool unproven) noexcept {
    const SealWord word = seal_check->Open(received.datagram, {UtcNowNs(), rt::MonotonicNowNs()});
    received.identity = seal_check->sender();
    received.proven = word == SealWord::kGood;
    if (received.proven || (unproven && word == SealWord::kClock)) return true;
    refused_of[static_cast<std::size_t>(word)].store(received.sender, std::memory_order_relaxed);
    return false;
  }

  struct About {  ///< the kernel's word on one datagram
    alignas(cmsghdr) std::array<std::uint8_t, CMSG_SPACE(sizeof(in_pktinfo))> bytes{};
  };

  unsigned only_interface;  ///< 0: any
  std::atomic<std::uint64_t> foreign{0};
  std::unique_ptr<SealCheck> seal_check;  ///< null: no key
  std::array<std::atomic<std::uint64_t>, kSealWords> refused_of{};
  std::array<bool, kSealWords> told{};
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
    : spin_ns_(spin_ns), url_(network.Url(direction)) {
  batch_ = std::make_unique<Batch>(network.this_machine_only() ? Loopback() : 0,
                                   Seals(network, direction));
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
  ip_mreqn membership = Interface(network);
  membership.imr_multiaddr = group.sin_addr;
  if (!Set(socket_, IPPROTO_IP, IP_ADD_MEMBERSHIP, membership)) {
    Fail(socket_, network, direction, "join the group");
  }
}

MulticastReceiver::~MulticastReceiver() { close(socket_); }

std::uint64_t MulticastReceiver::refused() const noexcept {
  std::uint64_t sum = batch_->foreign.load(std::memory_order_relaxed);
  if (!batch_->seal_check) return sum;
  for (const SealWord word : kRefusals) sum += batch_->seal_check->count(word);
  return sum;
}

void MulticastReceiver::Trust() noexcept {
  if (batch_->seal_check) batch_->seal_check->Trust(rt::MonotonicNowNs());
}

std::uint64_t MulticastReceiver::Challenge() noexcept {
  return batch_->seal_check ? batch_->seal_check->Challenge(rt::MonotonicNowNs()) : 0;
}

std::string MulticastReceiver::TakeNews() {
  std::string news;
  if (!batch_->seal_check) return news;
  for (const SealWord word : kRefusals) {
    const auto at = static_cast<std::size_t>(word);
    const std::uint64_t sender = batch_->refused_of.at(at).load(std::memory_order_relaxed);
    if (sender == 0 || batch_->told.at(at)) continue;
    batch_->told.at(at) = true;
    news += fmt::format("{}messages {} are refused at {}, from {}{}", news.empty() ? "" : "; ",
                        Text(word), url_, AddressText(sender),
                        word == SealWord::kClock ? ClockText(*batch_->seal_check) : "");
  }
  return news;
}

std::string MulticastReceiver::Trouble() const {
  std::string text;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "refused: " : ", ", count, what);
  };
  add(batch_->foreign.load(std::memory_order_relaxed), "through another interface");
  if (batch_->seal_check) {
    for (const SealWord word : kRefusals) add(batch_->seal_check->count(word), Text(word));
  }
  return text;
}

bool MulticastReceiver::Filter(std::span<const sock_filter> program) noexcept {
  // The kernel's interface takes a pointer to what it only reads.
  std::vector<sock_filter> steps(program.begin(), program.end());
  const sock_fprog filter{static_cast<unsigned short>(steps.size()), steps.data()};
  return Set(socket_, SOL_SOCKET, SO_ATTACH_FILTER, filter);
}

Received MulticastReceiver::Poll() noexcept {
  Received received;
  // A batch of which nothing may be taken does not mean that nothing is left.
  for (int batch = 0; batch < kFruitlessBatches && received.datagram.empty(); ++batch) {
    batch_->Fetch(socket_);
    received = batch_->Take(unproven_);
    if (batch_->filled < kBatch) break;
  }
  return received;
}

Received MulticastReceiver::Next() noexcept {
  const Received received = batch_->Take(unproven_);
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
  if (const Received queued = batch_->Take(unproven_); !queued.datagram.empty()) return queued;
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
