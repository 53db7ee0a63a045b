#pragma once
// Batches of measured torsion to and from the bytes of torsion_batch_t, on the wire and in files.
//
// Integrity  a CRC-32 over the message with the CRC field zero.
// Thread     one codec per thread; after construction Encode into room that is there and Decode
//            allocate nothing.
// Failure    Decode is false, and `batch` untouched, for damaged or foreign bytes, for counts
//            that no batch has, and for values that are not samples times couplings.

#include <cstdint>
#include <levitas_msg/torsion_batch_t.hpp>
#include <span>
#include <vector>

#include "common/torsion_batch.hpp"

namespace levitas {

class TorsionCodec {
 public:
  TorsionCodec();
  /// Bytes that Encode needs at most.
  [[nodiscard]] static std::size_t LargestSize();
  /// The number of bytes written to `to`; 0 when they do not fit, or when the batch names
  /// more values than it has room for.
  [[nodiscard]] std::size_t Encode(const TorsionBatch& batch, std::span<std::uint8_t> to) noexcept;
  [[nodiscard]] bool Decode(std::span<const std::uint8_t> bytes, TorsionBatch& batch) noexcept;

 private:
  levitas_msg::torsion_batch_t message_{};
};

}  // namespace levitas
