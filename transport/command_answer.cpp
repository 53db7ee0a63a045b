#include "transport/command_answer.hpp"

#include <arpa/inet.h>

#include <levitas_msg/command_answer_t.hpp>
#include <utility>

#include "lcmtypes/checked_decode.hpp"

namespace levitas::transport {

namespace {
constexpr std::int8_t kAccepted = 1;
constexpr std::int8_t kRefused = 2;
constexpr std::int32_t kMostPort = 65'535;
}  // namespace

void SetSender(CommandAnswer& answer, const CommandOrigin& origin) noexcept {
  answer.sequence = origin.sequence;
  answer.sender_address = ntohl(static_cast<std::uint32_t>(origin.sender >> 16U));
  answer.sender_port = ntohs(static_cast<std::uint16_t>(origin.sender & 0xffffU));
}

std::vector<std::uint8_t> EncodeAnswer(const CommandAnswer& answer) {
  levitas_msg::command_answer_t message{};
  message.sequence = answer.sequence;
  message.sender_address = static_cast<std::int32_t>(answer.sender_address);
  message.sender_port = answer.sender_port;
  message.command = static_cast<std::int8_t>(answer.command);
  message.outcome = answer.refused ? kRefused : kAccepted;
  message.cycle = static_cast<std::int64_t>(answer.cycle);
  message.text = answer.text;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

std::optional<CommandAnswer> ReadAnswer(std::span<const std::uint8_t> payload) {
  levitas_msg::command_answer_t message{};
  const bool sound = message::DecodeChecked(payload, message) && message.command > 0 &&
                     message.command < kOperatorCommandCount && message.sender_port > 0 &&
                     message.sender_port <= kMostPort &&
                     (message.outcome == kAccepted || message.outcome == kRefused);
  if (!sound) return std::nullopt;
  return CommandAnswer{.sequence = message.sequence,
                       .sender_address = static_cast<std::uint32_t>(message.sender_address),
                       .sender_port = static_cast<std::uint16_t>(message.sender_port),
                       .command = static_cast<OperatorCommand>(message.command),
                       .refused = message.outcome == kRefused,
                       .cycle = static_cast<std::uint64_t>(message.cycle),
                       .text = std::move(message.text)};
}

}  // namespace levitas::transport
