#pragma once
// End-to-end protection of a payload: a checksum over its data and its identity, and an alive
// counter. AUTOSAR E2E Protocol Specification (R20-11), profiles 11 and 5.
//
// Profile 11  up to 16 bytes. Byte 0: CRC-8 with the polynomial of SAE J1850 (0x1D), in this
//             profile from 0 and without final inversion, over Data ID low byte, Data ID high byte,
//             byte 1 to the end. Byte 1, low nibble: counter 0 to 14; high nibble: free for data
//             (Data ID mode "both").
// Profile 5   beyond. Bytes 0 and 1: CRC-16 CCITT-FALSE (polynomial 0x1021, start 0xFFFF), low byte
//             first, over byte 2 to the end, Data ID low byte, Data ID high byte. Byte 2: counter
//             0 to 255.
// Detects     any error burst up to the width of the checksum; other damage with 1 - 2^-8 or
//             1 - 2^-16; a payload under another Data ID; repetition and loss by the counter.
// Thread      any; no allocation, no failure.

#include <cstdint>
#include <span>

namespace levitas::can {

enum class Profile : std::uint8_t { k11, k5 };

/// The profile for a payload of this length, and what it leaves to data.
[[nodiscard]] constexpr Profile ProfileFor(std::size_t bytes) noexcept {
  return bytes <= 16 ? Profile::k11 : Profile::k5;
}
/// Bits 0 to this are the protection's.
[[nodiscard]] constexpr std::uint16_t ProtectionBits(Profile profile) noexcept {
  return profile == Profile::k11 ? 12 : 24;
}
/// The counter runs from 0 to this, exclusive.
[[nodiscard]] constexpr std::uint32_t CounterModulus(Profile profile) noexcept {
  return profile == Profile::k11 ? 15 : 256;
}

/// CRC-8 SAE J1850; the check value of "123456789" is 0x4B.
[[nodiscard]] std::uint8_t Crc8J1850(std::span<const std::uint8_t> data) noexcept;
/// CRC-16 CCITT-FALSE; the check value of "123456789" is 0x29B1.
[[nodiscard]] std::uint16_t Crc16Ccitt(std::span<const std::uint8_t> data) noexcept;

/// Writes counter and checksum into a payload whose data is complete. `payload` has at least 2
/// bytes (profile 11) or 3 (profile 5).
void Protect(Profile profile, std::uint16_t data_id, std::uint8_t counter,
             std::span<std::uint8_t> payload) noexcept;

/// True when the checksum fits and the counter is a possible one.
[[nodiscard]] bool Intact(Profile profile, std::uint16_t data_id,
                          std::span<const std::uint8_t> payload) noexcept;

/// The counter of an intact payload.
[[nodiscard]] std::uint8_t CounterOf(Profile profile,
                                     std::span<const std::uint8_t> payload) noexcept;

}  // namespace levitas::can
