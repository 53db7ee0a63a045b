#pragma once
// The only place where a message is decoded: what does not fit its type never reaches LCM's code.
//
// Thread   any; as many as there are messages.
// Failure  false, for foreign, damaged or hostile bytes; `message` then holds anything.

#include <cstdint>
#include <levitas_msg/layouts.hpp>
#include <limits>
#include <span>

#include "lcmtypes/payload_layout.hpp"

namespace levitas::message {

template <class Message>
[[nodiscard]] bool DecodeChecked(std::span<const std::uint8_t> payload, Message& message) {
  static_assert(!kLayout<Message>.empty(), "a message of lcmtypes/*.lcm");
  constexpr auto kLargest = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (payload.size() > kLargest || !Fits(kLayout<Message>, payload)) return false;
  const auto size = static_cast<int>(payload.size());
  return message.decode(payload.data(), 0, size) == size;
}

}  // namespace levitas::message
