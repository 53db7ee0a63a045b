#include "common/crc32.hpp"

#include <array>

namespace levitas {
namespace {

using Table = std::array<std::array<std::uint32_t, 256>, 4>;

// Four tables let the loop take four bytes at a time ("slicing by four").
constexpr Table MakeTable() {
  Table table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t value = byte;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1U) ? 0xEDB88320U : 0U);
    table[0][byte] = value;
  }
  for (std::size_t slice = 1; slice < 4; ++slice) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t previous = table[slice - 1][byte];
      table[slice][byte] = (previous >> 8) ^ table[0][previous & 0xFFU];
    }
  }
  return table;
}
constexpr Table kTable = MakeTable();

}  // namespace

std::uint32_t Crc32(const void* data, std::size_t size, std::uint32_t seed) noexcept {
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::uint32_t crc = ~seed;
  for (; size >= 4; size -= 4, bytes += 4) {
    crc ^= static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8 |
           static_cast<std::uint32_t>(bytes[2]) << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
    crc = kTable[3][crc & 0xFFU] ^ kTable[2][(crc >> 8) & 0xFFU] ^ kTable[1][(crc >> 16) & 0xFFU] ^
          kTable[0][crc >> 24];
  }
  for (; size > 0; --size, ++bytes) crc = (crc >> 8) ^ kTable[0][(crc ^ *bytes) & 0xFFU];
  return ~crc;
}

}  // namespace levitas
