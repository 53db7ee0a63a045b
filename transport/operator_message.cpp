#include "transport/operator_message.hpp"

#include <cmath>
#include <levitas_msg/excitation_request_t.hpp>
#include <levitas_msg/operator_command_t.hpp>
#include <utility>

#include "lcmtypes/checked_decode.hpp"

namespace levitas::transport {

std::optional<NetworkCommand> ReadCommand(const Packet& packet, std::uint64_t sender) {
  levitas_msg::operator_command_t message{};
  const bool sound = message::DecodeChecked(packet.payload, message) && message.command > 0 &&
                     message.command < kOperatorCommandCount &&
                     static_cast<OperatorCommand>(message.command) != OperatorCommand::kExcite &&
                     std::isfinite(message.speed_rad_per_s) &&
                     std::isfinite(message.acceleration_rad_per_s2);
  if (!sound) return std::nullopt;
  return NetworkCommand{.command = static_cast<OperatorCommand>(message.command),
                        .speed_rad_per_s = message.speed_rad_per_s,
                        .acceleration_rad_per_s2 = message.acceleration_rad_per_s2,
                        .origin = {sender, message.sequence}};
}

std::optional<NetworkExcitation> ReadExcitation(const Packet& packet, std::uint64_t sender) {
  if (packet.payload.size() > kLongestExcitation) return std::nullopt;
  levitas_msg::excitation_request_t message{};
  if (!message::DecodeChecked(packet.payload, message)) return std::nullopt;
  return NetworkExcitation{.step_yaml = std::move(message.step_yaml),
                           .origin = {sender, message.sequence}};
}

bool IsEmergencyStop(const Received& received, CommandOrigin& origin) {
  const Packet packet = ParsePacket(received.datagram);
  if (packet.kind != PacketKind::kShort || packet.channel != channel::kCommand) return false;
  const auto command = ReadCommand(packet, received.sender);
  if (!command || command->command != OperatorCommand::kEmergencyStop) return false;
  origin = command->origin;
  return true;
}

}  // namespace levitas::transport
