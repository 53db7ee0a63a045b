#pragma once
// Drawn numbers in ranges. Thread: that of the generator.

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "common/random.hpp"

namespace levitas::lives {

/// [ns] of a time in seconds.
[[nodiscard]] inline std::int64_t Ns(double seconds) {
  return static_cast<std::int64_t>(std::llround(seconds * 1e9));
}

class Ranges {
 public:
  explicit Ranges(Random& random) : random_(random) {}
  [[nodiscard]] double Between(double low, double high) const {
    return low + (high - low) * random_.Uniform();
  }
  /// Equal ratios are equally likely.
  [[nodiscard]] double Over(double low, double high) const {
    return low * std::pow(high / low, random_.Uniform());
  }
  [[nodiscard]] std::size_t One(std::size_t of) const { return random_.Bits() % of; }
  [[nodiscard]] bool Coin() const { return One(2) == 0; }

 private:
  Random& random_;
};

}  // namespace levitas::lives
