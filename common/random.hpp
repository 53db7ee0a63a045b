#pragma once
// Deterministic random numbers: the same seed gives the same sequence on every machine and
// library (std::normal_distribution is not specified bit for bit, so it is not used).
//
// Generator  xoshiro256++ (Blackman & Vigna 2019), seeded through splitmix64.
// Normal     Marsaglia's polar method.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace levitas {

class Random {
 public:
  explicit Random(std::uint64_t seed) noexcept {
    for (auto& word : state_) {
      seed += 0x9E3779B97F4A7C15ULL;
      std::uint64_t mixed = seed;
      mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9ULL;
      mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBULL;
      word = mixed ^ (mixed >> 31);
    }
  }

  [[nodiscard]] std::uint64_t Bits() noexcept {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// Uniform in [0, 1).
  [[nodiscard]] double Uniform() noexcept { return static_cast<double>(Bits() >> 11) * 0x1p-53; }

  /// Zero mean, unit variance.
  [[nodiscard]] double Normal() noexcept {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    double u = 0.0;
    double v = 0.0;
    double square = 0.0;
    do {
      u = 2.0 * Uniform() - 1.0;
      v = 2.0 * Uniform() - 1.0;
      square = u * u + v * v;
    } while (square >= 1.0 || square == 0.0);
    const double factor = std::sqrt(-2.0 * std::log(square) / square);
    spare_ = v * factor;
    has_spare_ = true;
    return u * factor;
  }

 private:
  std::array<std::uint64_t, 4> state_{};
  double spare_{0.0};
  bool has_spare_{false};
};

}  // namespace levitas
