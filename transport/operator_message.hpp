#pragma once
// What an operator sends, taken out of a datagram: a command, or a request for a test signal.
//
// Thread   any; no state.
// Failure  nothing, for what is no sound message of its kind: unknown commands, numbers that are
//          not finite, `excite` without a signal, texts beyond kLongestExcitation.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

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

/// A sound operator_command_t; nothing when the payload is none.
[[nodiscard]] std::optional<NetworkCommand> ReadCommand(const Packet& packet, std::uint64_t sender);
[[nodiscard]] std::optional<NetworkExcitation> ReadExcitation(const Packet& packet,
                                                              std::uint64_t sender);

/// True for an emergency stop; `origin` says whose.
[[nodiscard]] bool IsEmergencyStop(const Received& received, CommandOrigin& origin);

}  // namespace levitas::transport
