#pragma once
// A batch of measured torsion as a datagram of channel::kTorsion, in storage made once.
//
// Thread   one; after construction no allocation, no exception.

#include <cstdint>
#include <span>
#include <vector>

#include "lcmtypes/torsion/torsion_codec.hpp"

namespace levitas::transport {

class TorsionPacket {
 public:
  TorsionPacket();
  /// Valid until the next call; empty for a batch that no message can hold.
  [[nodiscard]] std::span<const std::uint8_t> Encode(const TorsionBatch& batch) noexcept;

 private:
  TorsionCodec codec_;
  std::uint32_t sequence_{0};
  std::vector<std::uint8_t> datagram_;
};

}  // namespace levitas::transport
