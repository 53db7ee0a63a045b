#pragma once
// What an operator sends, taken out of a datagram: a command, or a request for a test signal.
//
// Thread   any; no state.
// Unused   what a command does not use may hold anything: it is not read, and is 0 in the result.
// Failure  nothing, for what is no sound message of its kind: unknown commands, numbers of a spin
//          that are not finite, `excite` without a signal, texts beyond kLongestExcitation.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/enums.hpp"
#include "common/stop_latch.hpp"
#include "transport/lcm_packet.hpp"
#include "transport/multicast_socket.hpp"

namespace levitas::transport {

struct NetworkCommand {
  OperatorCommand command{OperatorCommand::kNone};
  double speed_rad_per_s{};
  double acceleration_rad_per_s2{};
  CommandOrigin origin;
  std::uint64_t stops_before{};  ///< emergency stops that the sender's message came behind
};

struct NetworkExcitation {
  std::string step_yaml;
  CommandOrigin origin;
  std::uint64_t stops_before{};
};

inline constexpr std::size_t kLongestExcitation = 4096;  ///< [byte] of an excitation_request_t

/// On a network with a key: what a command has to carry, and who asked for it.
struct Challenge {
  std::uint64_t value{};     ///< never 0
  std::uint64_t asked_by{};  ///< MulticastSender::identity
};

/// A sound operator_command_t; nothing when the payload is none.
[[nodiscard]] std::optional<NetworkCommand> ReadCommand(const Packet& packet, std::uint64_t sender);
[[nodiscard]] std::optional<NetworkExcitation> ReadExcitation(const Packet& packet,
                                                              std::uint64_t sender);

/// True for an emergency stop; `origin` says whose.
[[nodiscard]] bool IsEmergencyStop(const Received& received, CommandOrigin& origin);

/// What a good seal alone is enough for: an emergency stop, for whom an old one costs a trip and a
/// refused one a machine; and the question for a challenge, which moves nothing.
[[nodiscard]] bool SealSuffices(std::span<const std::uint8_t> datagram) noexcept;

[[nodiscard]] std::vector<std::uint8_t> EncodeChallenge(const Challenge& challenge);
[[nodiscard]] std::optional<Challenge> ReadChallenge(std::span<const std::uint8_t> payload);

}  // namespace levitas::transport
