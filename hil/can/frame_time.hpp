#pragma once
// How long a frame occupies the bus at worst: every stuff bit that the rules can demand, the
// inter-frame space included.
//
// Classical   47 + 8n + floor((34 + 8n - 1) / 4) bits (Davis, Burns, Bril and Lukkien 2007,
//             Real-Time Systems 35, equation (2)).
// CAN FD      ISO 11898-1:2015. At the arbitration rate: 17 bits to BRS with floor(16 / 4) stuff
//             bits, 13 from the delimiter of the checksum to the end of the space. At the data
//             rate: ESI, DLC and data, 5 + 8n bits with floor((5 + 8n) / 4) stuff bits, then stuff
//             count and checksum with their fixed stuff bits: 27 bits to 16 bytes, 32 beyond.
// Identifier  11 bits.
// Thread      any; constexpr.

#include <cstdint>

namespace levitas::can {

struct BitRates {
  double arbitration_bit_per_s{};
  double data_bit_per_s{};  ///< 0: classical CAN
};

/// [s] `payload_bytes` is a length that the format knows (PayloadLength).
[[nodiscard]] constexpr double WorstFrameSeconds(std::size_t payload_bytes,
                                                 const BitRates& rates) noexcept {
  const auto data_bits = static_cast<int>(8 * payload_bytes);
  if (rates.data_bit_per_s <= 0.0) {
    const int bits = 47 + data_bits + (34 + data_bits - 1) / 4;
    return bits / rates.arbitration_bit_per_s;
  }
  constexpr int kArbitrationBits = 17 + 16 / 4 + 13;
  const int checksum_bits = payload_bytes <= 16 ? 27 : 32;
  const int fast_bits = 5 + data_bits + (5 + data_bits) / 4 + checksum_bits;
  return kArbitrationBits / rates.arbitration_bit_per_s + fast_bits / rates.data_bit_per_s;
}

}  // namespace levitas::can
