#include "hil/can/protection.hpp"

#include <array>

namespace levitas::can {
namespace {

constexpr std::uint8_t kCounterMask = 0x0F;

constexpr std::array<std::uint8_t, 256> kTable8 = [] {
  std::array<std::uint8_t, 256> table{};
  for (unsigned value = 0; value < 256; ++value) {
    unsigned crc = value;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x80U) != 0 ? (crc << 1U) ^ 0x11DU : crc << 1U;
    table[value] = static_cast<std::uint8_t>(crc);
  }
  return table;
}();

constexpr std::array<std::uint16_t, 256> kTable16 = [] {
  std::array<std::uint16_t, 256> table{};
  for (unsigned value = 0; value < 256; ++value) {
    unsigned crc = value << 8U;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 0x8000U) != 0 ? (crc << 1U) ^ 0x11021U : crc << 1U;
    }
    table[value] = static_cast<std::uint16_t>(crc);
  }
  return table;
}();

std::uint8_t Step8(std::uint8_t crc, std::uint8_t byte) noexcept { return kTable8[crc ^ byte]; }
std::uint16_t Step16(std::uint16_t crc, std::uint8_t byte) noexcept {
  return static_cast<std::uint16_t>((crc << 8U) ^ kTable16[(crc >> 8U) ^ byte]);
}
std::uint8_t Low(std::uint16_t word) noexcept { return static_cast<std::uint8_t>(word & 0xFFU); }
std::uint8_t High(std::uint16_t word) noexcept { return static_cast<std::uint8_t>(word >> 8U); }

std::uint8_t Checksum11(std::uint16_t data_id, std::span<const std::uint8_t> payload) noexcept {
  std::uint8_t crc = Step8(Step8(0, Low(data_id)), High(data_id));
  for (const std::uint8_t byte : payload.subspan(1)) crc = Step8(crc, byte);
  return crc;
}

std::uint16_t Checksum5(std::uint16_t data_id, std::span<const std::uint8_t> payload) noexcept {
  std::uint16_t crc = 0xFFFF;
  for (const std::uint8_t byte : payload.subspan(2)) crc = Step16(crc, byte);
  return Step16(Step16(crc, Low(data_id)), High(data_id));
}

}  // namespace

std::uint8_t Crc8J1850(std::span<const std::uint8_t> data) noexcept {
  std::uint8_t crc = 0xFF;
  for (const std::uint8_t byte : data) crc = Step8(crc, byte);
  return crc ^ 0xFFU;
}

std::uint16_t Crc16Ccitt(std::span<const std::uint8_t> data) noexcept {
  std::uint16_t crc = 0xFFFF;
  for (const std::uint8_t byte : data) crc = Step16(crc, byte);
  return crc;
}

void Protect(Profile profile, std::uint16_t data_id, std::uint8_t counter,
             std::span<std::uint8_t> payload) noexcept {
  if (profile == Profile::k11) {
    payload[1] = static_cast<std::uint8_t>((payload[1] & ~kCounterMask) | (counter & kCounterMask));
    payload[0] = Checksum11(data_id, payload);
    return;
  }
  payload[2] = counter;
  const std::uint16_t crc = Checksum5(data_id, payload);
  payload[0] = Low(crc);
  payload[1] = High(crc);
}

bool Intact(Profile profile, std::uint16_t data_id,
            std::span<const std::uint8_t> payload) noexcept {
  if (profile == Profile::k11) {
    return payload.size() >= 2 && payload[0] == Checksum11(data_id, payload) &&
           CounterOf(profile, payload) < CounterModulus(profile);
  }
  if (payload.size() < 3) return false;
  const std::uint16_t crc = Checksum5(data_id, payload);
  return payload[0] == Low(crc) && payload[1] == High(crc);
}

std::uint8_t CounterOf(Profile profile, std::span<const std::uint8_t> payload) noexcept {
  return profile == Profile::k11 ? payload[1] & kCounterMask : payload[2];
}

}  // namespace levitas::can
