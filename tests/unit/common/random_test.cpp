#include "common/random.hpp"

#include <gtest/gtest.h>

namespace levitas {
namespace {

TEST(Random, SameSeedSameBitsOtherSeedOtherBits) {
  Random a{7};
  Random b{7};
  Random c{8};
  bool differs = false;
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t bits = a.Bits();
    EXPECT_EQ(bits, b.Bits());
    differs = differs || bits != c.Bits();
  }
  EXPECT_TRUE(differs);
}

// With 1e6 draws the standard error of the mean is 1e-3, of the variance 1.4e-3, of the fourth
// moment about 1e-2; the bands are five of them.
TEST(Random, NormalHasTheMomentsOfTheNormalDistribution) {
  Random draw{20261121};
  double mean = 0.0;
  double square = 0.0;
  double fourth = 0.0;
  constexpr int kCount = 1'000'000;
  for (int i = 0; i < kCount; ++i) {
    const double x = draw.Normal();
    mean += x;
    square += x * x;
    fourth += x * x * x * x;
  }
  EXPECT_NEAR(mean / kCount, 0.0, 5e-3);
  EXPECT_NEAR(square / kCount, 1.0, 7e-3);
  EXPECT_NEAR(fourth / kCount, 3.0, 5e-2);
}

}  // namespace
}  // namespace levitas
