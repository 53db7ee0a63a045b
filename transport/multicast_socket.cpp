#include "transport/multicast_socket.hpp"

#include <unistd.h>

#include <algorithm>
#include <vector>

#include "transport/lcm_packet.hpp"
#include "transport/multicast_options.hpp"
#include "transport/seal.hpp"

namespace levitas::transport {

struct MulticastSender::Sealing {
  Sealing(const SealingKey& key, bool to_challenge)
      : sealer(key), by_challenge(to_challenge), buffer(kMaxDatagram) {}
  [[nodiscard]] std::uint64_t Freshness() const noexcept {
    return by_challenge ? challenge : static_cast<std::uint64_t>(UtcNowNs());
  }

  Sealer sealer;
  bool by_challenge;
  std::uint64_t challenge{0};
  std::vector<std::uint8_t> buffer;
};

MulticastSender::MulticastSender(const LcmNetwork& network, Direction direction)
    : sealing_(network.key ? std::make_unique<Sealing>(KeyOf(network, direction),
                                                       direction == Direction::kCommand)
                           : nullptr) {
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0) Fail(socket_, network, direction, "socket");
  // Loop back: the partner is normally on this machine.
  if (!Set(socket_, IPPROTO_IP, IP_MULTICAST_LOOP, std::uint8_t{1}) ||
      !Set(socket_, IPPROTO_IP, IP_MULTICAST_TTL, static_cast<std::uint8_t>(network.ttl))) {
    Fail(socket_, network, direction, "setsockopt");
  }
  // A time to live of 0 alone would leave the choice of the interface to the routes.
  if (network.this_machine_only() &&
      !Set(socket_, IPPROTO_IP, IP_MULTICAST_IF, Interface(network))) {
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
  if (sealing_) {
    if (datagram.size() + kTrailerBytes > sealing_->buffer.size()) return false;
    std::copy(datagram.begin(), datagram.end(), sealing_->buffer.begin());
    datagram = sealing_->sealer.Append(sealing_->buffer, datagram.size(), sealing_->Freshness());
  }
  const auto sent = send(socket_, datagram.data(), datagram.size(), MSG_NOSIGNAL);
  return sent == static_cast<ssize_t>(datagram.size());
}

std::uint64_t MulticastSender::identity() const noexcept {
  return sealing_ ? sealing_->sealer.sender() : 0;
}

void MulticastSender::AnswerChallenge(std::uint64_t challenge) noexcept {
  if (sealing_) sealing_->challenge = challenge;
}

std::uint16_t MulticastSender::port() const noexcept {
  sockaddr_in own{};
  socklen_t size = sizeof(own);
  // The sockets' interface knows every address by this type.
  const bool known = getsockname(socket_, reinterpret_cast<sockaddr*>(&own), &size) == 0;
  return known ? ntohs(own.sin_port) : std::uint16_t{0};
}

}  // namespace levitas::transport
