#pragma once
// Pseudo-random binary sequence of maximum length: repeats after 2^order - 1 bits, holds
// 2^(order-1) ones and one zero fewer, and its autocorrelation at any other lag is -1/(2^order - 1)
// (Golomb 1967, Shift Register Sequences).
//
// Register  s[n] = XOR of the tapped bits; taps after Alfke (1996), Xilinx XAPP 052, table 3.
// Thread    any; no allocation; Next is a few instructions.
// Failure   an order outside 7 .. 23 counts as the nearest one allowed; files are checked before.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace levitas::scenario {

/// A word with the given bits set, counted from 1; 0 sets none.
[[nodiscard]] constexpr std::uint32_t Taps(int a, int b, int c = 0, int d = 0) noexcept {
  std::uint32_t word = 0;
  for (const int n : {a, b, c, d}) word |= n == 0 ? 0U : 1U << (n - 1);
  return word;
}

/// Orders 7 to 23.
inline constexpr std::array<std::uint32_t, 17> kPrbsTaps{
    Taps(7, 6),        Taps(8, 6, 5, 4),  Taps(9, 5),        Taps(10, 7),  Taps(11, 9),
    Taps(12, 6, 4, 1), Taps(13, 4, 3, 1), Taps(14, 5, 3, 1), Taps(15, 14), Taps(16, 15, 13, 4),
    Taps(17, 14),      Taps(18, 11),      Taps(19, 6, 2, 1), Taps(20, 17), Taps(21, 19),
    Taps(22, 21),      Taps(23, 18)};

class Prbs {
 public:
  static constexpr int kLowestOrder = 7;
  static constexpr int kHighestOrder = 23;

  /// `start`, 0 <= start < 1: fraction of the period that lies before the first bit. Costs that
  /// many steps, at most 8.4 million.
  explicit constexpr Prbs(int order, double start = 0.0) noexcept
      : order_(std::clamp(order, kLowestOrder, kHighestOrder)) {
    const auto skipped = static_cast<std::uint32_t>(start * static_cast<double>(period()));
    for (std::uint32_t i = 0; i < skipped; ++i) (void)Next();
  }

  [[nodiscard]] constexpr std::uint32_t period() const noexcept { return (1U << order_) - 1U; }

  constexpr bool Next() noexcept {
    const bool bit = (state_ >> (order_ - 1)) & 1U;
    const std::uint32_t taps = kPrbsTaps[static_cast<std::size_t>(order_ - kLowestOrder)];
    const auto feedback = static_cast<std::uint32_t>(std::popcount(state_ & taps)) & 1U;
    state_ = ((state_ << 1U) | feedback) & period();
    return bit;
  }

 private:
  int order_;
  std::uint32_t state_{1};  // any state but zero lies on the one long cycle
};

}  // namespace levitas::scenario
