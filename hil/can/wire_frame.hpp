#pragma once
// One data frame as it lies on a CAN bus, without its transport.
//
// Identifier  11 bits; the extended format is not used.
// Length      0 to 8 (classical), and 12, 16, 20, 24, 32, 48, 64 with CAN FD.

#include <array>
#include <cstdint>
#include <span>

namespace levitas::can {

inline constexpr std::size_t kMaxPayload = 64;

struct WireFrame {
  std::uint32_t id{};
  std::uint8_t length{};
  bool fd{};
  std::array<std::uint8_t, kMaxPayload> data{};
  std::int64_t received_ns{};  ///< CLOCK_MONOTONIC of the kernel's time stamp; 0: none

  [[nodiscard]] std::span<std::uint8_t> payload() noexcept { return {data.data(), length}; }
  [[nodiscard]] std::span<const std::uint8_t> payload() const noexcept {
    return {data.data(), length};
  }
};

/// Smallest length that holds `bytes`; `bytes` at most 8 (classical) or 64 (FD).
[[nodiscard]] constexpr std::uint8_t PayloadLength(std::size_t bytes) noexcept {
  for (const std::uint8_t length : std::array<std::uint8_t, 7>{12, 16, 20, 24, 32, 48, 64}) {
    if (bytes > 8 && bytes <= length) return length;
  }
  return static_cast<std::uint8_t>(bytes);
}

}  // namespace levitas::can
