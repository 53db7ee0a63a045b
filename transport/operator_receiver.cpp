#include "transport/operator_receiver.hpp"

#include <cmath>
#include <levitas_msg/operator_command_t.hpp>
#include <utility>

#include "controller/rt/clock.hpp"
#include "transport/lcm_packet.hpp"

namespace levitas::transport {

namespace {
constexpr std::int64_t kSliceNs = 50'000'000;  // how long the destructor may have to wait
}  // namespace

OperatorReceiver::OperatorReceiver(const LcmNetwork& network,
                                   std::function<void(const NetworkCommand&)> take)
    : receiver_(network, Direction::kCommand), take_(std::move(take)) {
  thread_ = std::thread([this] { Run(); });
}

OperatorReceiver::~OperatorReceiver() {
  stopping_.store(true);
  thread_.join();
}

void OperatorReceiver::Run() {
  while (!stopping_.load()) {
    const Received received = receiver_.Receive(rt::MonotonicNowNs() + kSliceNs);
    if (!received.datagram.empty()) Handle(received);
  }
}

bool OperatorReceiver::Repeated(std::uint64_t sender, std::int64_t sequence) noexcept {
  for (Seen& seen : seen_) {
    if (seen.sender != sender) continue;
    const bool repeated = seen.sequence == sequence;
    seen.sequence = sequence;
    return repeated;
  }
  seen_[next_seen_] = {sender, sequence};
  next_seen_ = (next_seen_ + 1) % kRemembered;
  return false;
}

void OperatorReceiver::Handle(const Received& received) {
  const Packet packet = ParsePacket(received.datagram);
  if (packet.kind == PacketKind::kFragment) return;
  if (packet.kind == PacketKind::kShort && packet.channel != channel::kCommand) return;
  levitas_msg::operator_command_t message{};
  const int size = message.getEncodedSize();
  const bool sound = packet.kind == PacketKind::kShort &&
                     packet.payload.size() == static_cast<std::size_t>(size) &&
                     message.decode(packet.payload.data(), 0, size) == size &&
                     message.command > 0 && message.command < kOperatorCommandCount &&
                     std::isfinite(message.speed_rad_per_s) &&
                     std::isfinite(message.acceleration_rad_per_s2);
  if (!sound) {
    rejected_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  if (Repeated(received.sender, message.sequence)) return;
  take_({.command = static_cast<OperatorCommand>(message.command),
         .speed_rad_per_s = message.speed_rad_per_s,
         .acceleration_rad_per_s2 = message.acceleration_rad_per_s2});
}

}  // namespace levitas::transport
