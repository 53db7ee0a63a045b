#include "transport/lcm_packet.hpp"

#include <algorithm>

namespace levitas::transport {

namespace {

constexpr std::uint32_t kShortMagic = 0x4c433032;     // "LC02"
constexpr std::uint32_t kFragmentMagic = 0x4c433033;  // "LC03"
constexpr std::size_t kFixedPart = 8;

std::uint32_t ReadBig(std::span<const std::uint8_t> from, std::size_t at) noexcept {
  return (std::uint32_t{from[at]} << 24) | (std::uint32_t{from[at + 1]} << 16) |
         (std::uint32_t{from[at + 2]} << 8) | std::uint32_t{from[at + 3]};
}

void WriteBig(std::span<std::uint8_t> into, std::size_t at, std::uint32_t value) noexcept {
  for (std::size_t byte = 0; byte < 4; ++byte) {
    into[at + byte] = static_cast<std::uint8_t>(value >> (24 - 8 * byte));
  }
}

}  // namespace

Packet ParsePacket(std::span<const std::uint8_t> datagram) noexcept {
  Packet packet;
  if (datagram.size() < kFixedPart) return packet;
  const std::uint32_t magic = ReadBig(datagram, 0);
  packet.sequence = ReadBig(datagram, 4);
  if (magic == kFragmentMagic) {
    packet.kind = PacketKind::kFragment;
    return packet;
  }
  if (magic != kShortMagic) return packet;
  const auto name = datagram.subspan(kFixedPart);
  const auto searched = name.first(std::min(name.size(), kMaxChannel + 1));
  const auto end = std::find(searched.begin(), searched.end(), std::uint8_t{0});
  if (end == searched.end() || end == searched.begin()) return packet;
  const auto length = static_cast<std::size_t>(end - searched.begin());
  packet.kind = PacketKind::kShort;
  packet.channel = {reinterpret_cast<const char*>(name.data()), length};
  packet.payload = name.subspan(length + 1);
  return packet;
}

void WriteHeader(std::span<std::uint8_t> into, std::uint32_t sequence,
                 std::string_view channel) noexcept {
  WriteBig(into, 0, kShortMagic);
  WriteBig(into, 4, sequence);
  const auto end = std::copy(channel.begin(), channel.end(), into.begin() + kFixedPart);
  *end = 0;
}

}  // namespace levitas::transport
