#pragma once
// The controller's answer to one command, as it goes over the network (command_answer_t).
//
// Thread   any; no state.
// Failure  Read gives nothing for what is no sound answer.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/enums.hpp"
#include "common/stop_latch.hpp"

namespace levitas::transport {

struct CommandAnswer {
  std::int64_t sequence{};         ///< of the command
  std::uint32_t sender_address{};  ///< IPv4, host's byte order
  std::uint16_t sender_port{};
  OperatorCommand command{};
  bool refused{};
  std::uint64_t cycle{};
  std::string text;
};

/// As the receiver names a sender: Received::sender.
void SetSender(CommandAnswer& answer, const CommandOrigin& origin) noexcept;

[[nodiscard]] std::vector<std::uint8_t> EncodeAnswer(const CommandAnswer& answer);
[[nodiscard]] std::optional<CommandAnswer> ReadAnswer(std::span<const std::uint8_t> payload);

}  // namespace levitas::transport
