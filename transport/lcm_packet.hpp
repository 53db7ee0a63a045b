#pragma once
// LCM's documented "short message": one UDP datagram
//
//   'LC02' (0x4c433032) | sequence, 32 bit | channel name | 0 | payload        all big-endian
//
// (Olson and Moore, LCM UDP multicast protocol description, version 1.) Longer messages travel as
// 'LC03' fragments, which nothing on the per-cycle path is long enough to need.
//
// Thread   any; no state, no allocation.
// Failure  a malformed datagram is a kind, not an error: whatever the bus carries, parsing is safe.

#include <cstdint>
#include <span>
#include <string_view>

namespace levitas::transport {

inline constexpr std::size_t kMaxDatagram = 65'507;  ///< [byte] UDP payload over IPv4
inline constexpr std::size_t kMaxChannel = 63;       ///< [byte] LCM's limit, without the zero

enum class PacketKind : std::uint8_t { kShort, kFragment, kMalformed };

struct Packet {
  PacketKind kind{PacketKind::kMalformed};
  std::uint32_t sequence{};
  std::string_view channel{};               ///< views into the datagram
  std::span<const std::uint8_t> payload{};  ///< views into the datagram
};

/// Takes a datagram apart; the result views `datagram` and lives no longer.
[[nodiscard]] Packet ParsePacket(std::span<const std::uint8_t> datagram) noexcept;

/// Bytes before the payload of a message on `channel`.
[[nodiscard]] constexpr std::size_t HeaderSize(std::string_view channel) noexcept {
  return 8 + channel.size() + 1;
}

/// Writes the header; `into` must hold HeaderSize(channel) bytes.
void WriteHeader(std::span<std::uint8_t> into, std::uint32_t sequence,
                 std::string_view channel) noexcept;

}  // namespace levitas::transport
