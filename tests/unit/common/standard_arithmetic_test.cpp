#include "common/standard_arithmetic.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace levitas {
namespace {

// The compiler must not compute it beforehand.
double HalfOfTheSmallestNormalNumber() {
  const volatile double smallest = std::numeric_limits<double>::min();
  const volatile double half = 0.5;
  return smallest * half;
}

#if defined(__SSE2__)
// What a library built with -ffast-math does when it is loaded.
void FlushSubnormals() {
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _mm_setcsr(_mm_getcsr() | 0x0040U);  // subnormal inputs are zero, too
}

TEST(StandardArithmetic, KeepsSubnormalNumbersThatAThreadOtherwiseFlushesToZero) {
  double flushed = 1.0;
  double kept = 0.0;
  std::thread([&] {
    FlushSubnormals();
    flushed = HalfOfTheSmallestNormalNumber();
    UseStandardArithmetic();
    kept = HalfOfTheSmallestNormalNumber();
  }).join();
  EXPECT_EQ(flushed, 0.0) << "the harm";
  EXPECT_EQ(kept, std::numeric_limits<double>::min() / 2);
}

TEST(StandardArithmetic, RoundsToNearestWhateverTheThreadDidBefore) {
  double rounded = 0.0;
  std::thread([&] {
    std::fesetround(FE_UPWARD);
    UseStandardArithmetic();
    const volatile double one = 1.0;
    const volatile double tiny = 1e-300;
    rounded = one + tiny;
  }).join();
  EXPECT_EQ(rounded, 1.0);
}
#endif

}  // namespace
}  // namespace levitas
