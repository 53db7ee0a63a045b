#include "transport/torsion_packet.hpp"

#include "transport/lcm_network.hpp"
#include "transport/lcm_packet.hpp"

namespace levitas::transport {

TorsionPacket::TorsionPacket()
    : datagram_(HeaderSize(channel::kTorsion) + TorsionCodec::LargestSize()) {}

std::span<const std::uint8_t> TorsionPacket::Encode(const TorsionBatch& batch) noexcept {
  const std::size_t header = HeaderSize(channel::kTorsion);
  WriteHeader(datagram_, sequence_++, channel::kTorsion);
  const std::size_t size = codec_.Encode(batch, std::span(datagram_).subspan(header));
  if (size == 0) return {};
  return std::span(datagram_).first(header + size);
}

}  // namespace levitas::transport
