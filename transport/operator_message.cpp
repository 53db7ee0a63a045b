#include "transport/operator_message.hpp"

#include <cmath>
#include <levitas_msg/challenge_t.hpp>
#include <levitas_msg/excitation_request_t.hpp>
#include <levitas_msg/operator_command_t.hpp>
#include <utility>

#include "lcmtypes/checked_decode.hpp"

namespace levitas::transport {

std::optional<NetworkCommand> ReadCommand(const Packet& packet, std::uint64_t sender) {
  levitas_msg::operator_command_t message{};
  const bool sound = message::DecodeChecked(packet.payload, message) && message.command > 0 &&
                     message.command < kOperatorCommandCount &&
                     static_cast<OperatorCommand>(message.command) != OperatorCommand::kExcite;
  if (!sound) return std::nullopt;
  NetworkCommand command{.command = static_cast<OperatorCommand>(message.command),
                         .origin = {sender, message.sequence}};
  if (command.command != OperatorCommand::kSpin) return command;
  if (!std::isfinite(message.speed_rad_per_s) || !std::isfinite(message.acceleration_rad_per_s2)) {
    return std::nullopt;
  }
  command.speed_rad_per_s = message.speed_rad_per_s;
  command.acceleration_rad_per_s2 = message.acceleration_rad_per_s2;
  return command;
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

bool SealSuffices(std::span<const std::uint8_t> datagram) noexcept {
  CommandOrigin origin;
  return ParsePacket(datagram).channel == channel::kHello ||
         IsEmergencyStop({.datagram = datagram}, origin);
}

std::vector<std::uint8_t> EncodeChallenge(const Challenge& challenge) {
  levitas_msg::challenge_t message{};
  message.challenge = static_cast<std::int64_t>(challenge.value);
  message.asked_by = static_cast<std::int64_t>(challenge.asked_by);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

std::optional<Challenge> ReadChallenge(std::span<const std::uint8_t> payload) {
  levitas_msg::challenge_t message{};
  if (!message::DecodeChecked(payload, message) || message.challenge == 0) return std::nullopt;
  return Challenge{.value = static_cast<std::uint64_t>(message.challenge),
                   .asked_by = static_cast<std::uint64_t>(message.asked_by)};
}

}  // namespace levitas::transport
