#include "transport/operator_receiver.hpp"

#include <cmath>
#include <levitas_msg/excitation_request_t.hpp>
#include <levitas_msg/operator_command_t.hpp>
#include <utility>

#include "controller/rt/clock.hpp"
#include "controller/rt/thread_trouble.hpp"
#include "lcmtypes/checked_decode.hpp"
#include "transport/lcm_packet.hpp"

namespace levitas::transport {

namespace {
constexpr std::int64_t kSliceNs = 50'000'000;  // how long the destructor may have to wait
}  // namespace

OperatorReceiver::OperatorReceiver(const LcmNetwork& network,
                                   std::function<void(const NetworkCommand&)> take,
                                   std::function<void(const std::string&)> excite)
    : receiver_(network, Direction::kCommand), take_(std::move(take)), excite_(std::move(excite)) {
  thread_ = std::thread([this] { Run(); });
}

OperatorReceiver::~OperatorReceiver() {
  stopping_.store(true);
  thread_.join();
}

void OperatorReceiver::Run() {
  while (!stopping_.load()) {
    rt::Guarded("commands", [this] {
      const Received received = receiver_.Receive(rt::MonotonicNowNs() + kSliceNs);
      if (!received.datagram.empty()) Handle(received);
    });
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
  if (packet.kind != PacketKind::kShort) {
    Reject();
  } else if (packet.channel == channel::kCommand) {
    HandleCommand(packet, received.sender);
  } else if (packet.channel == channel::kExcitation && excite_) {
    HandleExcitation(packet, received.sender);
  }
}

void OperatorReceiver::HandleCommand(const Packet& packet, std::uint64_t sender) {
  levitas_msg::operator_command_t message{};
  const bool sound = message::DecodeChecked(packet.payload, message) && message.command > 0 &&
                     message.command < kOperatorCommandCount &&
                     static_cast<OperatorCommand>(message.command) != OperatorCommand::kExcite &&
                     std::isfinite(message.speed_rad_per_s) &&
                     std::isfinite(message.acceleration_rad_per_s2);
  if (!sound) return Reject();
  if (Repeated(sender, message.sequence)) return;
  take_({.command = static_cast<OperatorCommand>(message.command),
         .speed_rad_per_s = message.speed_rad_per_s,
         .acceleration_rad_per_s2 = message.acceleration_rad_per_s2});
}

void OperatorReceiver::HandleExcitation(const Packet& packet, std::uint64_t sender) {
  levitas_msg::excitation_request_t message{};
  const bool sound =
      packet.payload.size() <= kLongestText && message::DecodeChecked(packet.payload, message);
  if (!sound) return Reject();
  if (!Repeated(sender, message.sequence)) excite_(message.step_yaml);
}

}  // namespace levitas::transport
