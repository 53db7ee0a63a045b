#pragma once
// Fixed-bin histogram of durations: cheap enough for the loop thread, copied whole.
//
// Bins      logarithmic, 16 per octave (4.4 % wide) from 1 ns to 2^40 ns; no allocation.
// Thread    one writer; copy it in that thread, or after it has stopped.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace levitas {

class Histogram {
 public:
  static constexpr int kSubBits = 4;
  static constexpr std::size_t kBins = (40U << kSubBits) + 1U;

  void Add(std::int64_t duration_ns) noexcept {
    const std::uint64_t value = duration_ns < 0 ? 0U : static_cast<std::uint64_t>(duration_ns);
    ++bins_[std::min(Bin(value), kBins - 1)];
    ++count_;
    max_ns_ = std::max(max_ns_, duration_ns);
  }

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] std::int64_t max_ns() const noexcept { return max_ns_; }
  [[nodiscard]] const std::array<std::uint32_t, kBins>& bins() const noexcept { return bins_; }

  /// The duration [ns] below which the fraction `p` of all values lie (upper edge of its bin);
  /// 0 when empty.
  [[nodiscard]] double Percentile(double p) const noexcept {
    if (count_ == 0) return 0.0;
    const double wanted = p * static_cast<double>(count_);
    double seen = 0.0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      seen += static_cast<double>(bins_[bin]);
      if (seen >= wanted) return std::min(UpperEdge(bin), static_cast<double>(max_ns_));
    }
    return static_cast<double>(max_ns_);
  }

  /// Largest value [ns] that falls into `bin`.
  [[nodiscard]] static double UpperEdge(std::size_t bin) noexcept {
    constexpr std::size_t kLinear = std::size_t{1} << kSubBits;
    if (bin < kLinear) return static_cast<double>(bin);
    const std::size_t octave = (bin >> kSubBits) - 1;
    const std::size_t step = (bin & (kLinear - 1)) + kLinear + 1;
    return static_cast<double>((step << octave) - 1);
  }

 private:
  [[nodiscard]] static std::size_t Bin(std::uint64_t value) noexcept {
    constexpr std::uint64_t kLinear = std::uint64_t{1} << kSubBits;
    if (value < kLinear) return static_cast<std::size_t>(value);
    const int octave = static_cast<int>(std::bit_width(value)) - 1 - kSubBits;
    const std::uint64_t mantissa = (value >> octave) & (kLinear - 1);
    return (static_cast<std::size_t>(octave + 1) << kSubBits) + static_cast<std::size_t>(mantissa);
  }

  std::array<std::uint32_t, kBins> bins_{};
  std::uint64_t count_{0};
  std::int64_t max_ns_{0};
};

}  // namespace levitas
