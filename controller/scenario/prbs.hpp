#pragma once
// Pseudo-random binary sequence of maximum length: repeats after 2^order - 1 bits, holds
// 2^(order-1) ones and one zero fewer, and its autocorrelation at any other lag is -1/(2^order - 1)
// (Golomb 1967, Shift Register Sequences).
//
// Register  s[n] = XOR of the tapped bits; taps after Alfke (1996), Xilinx XAPP 052, table 3.
// Start     anywhere in the period at no cost: the register's step is a matrix over two elements,
//           and its powers are made by squaring.
// Thread    any; no allocation; Next is a few instructions.
// Failure   an order outside 2 .. 31 counts as the nearest one allowed; files are checked before.

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

/// Orders 2 to 31.
inline constexpr std::array<std::uint32_t, 30> kPrbsTaps{
    Taps(2, 1),        Taps(3, 2),        Taps(4, 3),           Taps(5, 3),
    Taps(6, 5),        Taps(7, 6),        Taps(8, 6, 5, 4),     Taps(9, 5),
    Taps(10, 7),       Taps(11, 9),       Taps(12, 6, 4, 1),    Taps(13, 4, 3, 1),
    Taps(14, 5, 3, 1), Taps(15, 14),      Taps(16, 15, 13, 4),  Taps(17, 14),
    Taps(18, 11),      Taps(19, 6, 2, 1), Taps(20, 17),         Taps(21, 19),
    Taps(22, 21),      Taps(23, 18),      Taps(24, 23, 22, 17), Taps(25, 22),
    Taps(26, 6, 2, 1), Taps(27, 5, 2, 1), Taps(28, 25),         Taps(29, 27),
    Taps(30, 6, 4, 1), Taps(31, 28)};

class Prbs {
 public:
  static constexpr int kLowestOrder = 2;
  static constexpr int kHighestOrder = 31;

  /// `start`, 0 <= start < 1: fraction of the period that lies before the first bit.
  explicit constexpr Prbs(int order, double start = 0.0) noexcept
      : order_(std::clamp(order, kLowestOrder, kHighestOrder)) {
    Skip(static_cast<std::uint32_t>(start * static_cast<double>(period())));
  }

  /// Starts with the register's bits given, of which `order` count; if all are 0, with register 1.
  [[nodiscard]] static constexpr Prbs FromRegister(int order, std::uint32_t bits) noexcept {
    Prbs sequence(order);
    if ((bits & sequence.period()) != 0) sequence.state_ = bits & sequence.period();
    return sequence;
  }

  [[nodiscard]] constexpr std::uint32_t period() const noexcept { return (1U << order_) - 1U; }

  constexpr bool Next() noexcept {
    const bool bit = (state_ >> (order_ - 1)) & 1U;
    state_ = Step(state_);
    return bit;
  }

  /// As many calls of Next, at the cost of a few thousand instructions.
  constexpr void Skip(std::uint32_t bits) noexcept {
    std::array<std::uint32_t, kHighestOrder> power{};  // images of the unit vectors
    for (int i = 0; i < order_; ++i) power[Index(i)] = Step(1U << i);
    for (; bits != 0; bits >>= 1U) {
      if ((bits & 1U) != 0) state_ = Image(power, state_);
      std::array<std::uint32_t, kHighestOrder> square{};
      for (int i = 0; i < order_; ++i) square[Index(i)] = Image(power, power[Index(i)]);
      power = square;
    }
  }

 private:
  static constexpr std::size_t Index(int i) noexcept { return static_cast<std::size_t>(i); }

  [[nodiscard]] constexpr std::uint32_t Step(std::uint32_t state) const noexcept {
    const std::uint32_t taps = kPrbsTaps[Index(order_ - kLowestOrder)];
    const auto feedback = static_cast<std::uint32_t>(std::popcount(state & taps)) & 1U;
    return ((state << 1U) | feedback) & period();
  }

  [[nodiscard]] constexpr std::uint32_t Image(
      const std::array<std::uint32_t, kHighestOrder>& matrix, std::uint32_t state) const noexcept {
    std::uint32_t image = 0;
    for (int i = 0; i < order_; ++i) image ^= (state >> i & 1U) != 0 ? matrix[Index(i)] : 0U;
    return image;
  }

  int order_;
  std::uint32_t state_{1};  // any state but zero lies on the one long cycle
};

}  // namespace levitas::scenario
