#include "diagnosis/model/convolve.hpp"

#include "diagnosis/model/four.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kFour = 4;
constexpr std::size_t kBlock = 4 * kFour;  ///< sums that hide the latency of one another

LEVITAS_INLINE void ConvolveBody(const double* filter, std::size_t taps, const double* now,
                                 std::size_t count, double* to) noexcept {
  std::size_t n = 0;
  for (; n + kBlock <= count; n += kBlock) {
    Four s0{};
    Four s1{};
    Four s2{};
    Four s3{};
    Four x;
    for (std::size_t k = 0; k < taps; ++k) {
      const double* past = now + n - k;
      const double weight = filter[k];
      Load(past, x);
      s0 += weight * x;
      Load(past + kFour, x);
      s1 += weight * x;
      Load(past + 2 * kFour, x);
      s2 += weight * x;
      Load(past + 3 * kFour, x);
      s3 += weight * x;
    }
    Store(s0, to + n);
    Store(s1, to + n + kFour);
    Store(s2, to + n + 2 * kFour);
    Store(s3, to + n + 3 * kFour);
  }
  for (; n < count; ++n) {
    double sum = 0.0;
    for (std::size_t k = 0; k < taps; ++k) sum += filter[k] * *(now + n - k);
    to[n] = sum;
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void ConvolveAvx2(const double* filter, std::size_t taps, const double* now,
                                          std::size_t count, double* to) noexcept {
  ConvolveBody(filter, taps, now, count, to);
}
#endif

}  // namespace

void Convolve(const std::vector<double>& filter, const double* now, std::size_t count,
              double* to) noexcept {
#if defined(__x86_64__)
  static const bool kHasAvx2 = __builtin_cpu_supports("avx2") != 0;
  if (kHasAvx2) return ConvolveAvx2(filter.data(), filter.size(), now, count, to);
#endif
  ConvolveBody(filter.data(), filter.size(), now, count, to);
}

}  // namespace levitas::diagnosis
