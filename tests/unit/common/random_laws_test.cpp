// The generator against its publication, and its numbers against their distributions.

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>

#include "common/random.hpp"

namespace levitas {
namespace {

constexpr int kCount = 400'000;

TEST(Random, StartsAsXoshiroSeededByTheFirstFourNumbersOfSplitmix) {
  // Published first outputs of splitmix64 for seed 0; xoshiro256++ then gives
  // rotl(s0 + s3, 23) + s0 (Blackman and Vigna 2019).
  constexpr std::array<std::uint64_t, 4> kState{0xE220A8397B1DCDAF, 0x6E789E6AA1B965F4,
                                                0x06C45D188009454F, 0xF88BB8A8724C81EC};
  Random random(0);
  EXPECT_EQ(random.Bits(), std::rotl(kState[0] + kState[3], 23) + kState[0]);
}

TEST(Random, FillsEveryBinOfTheUnitIntervalEvenly) {
  Random random(1);
  std::array<int, 64> bins{};
  for (int i = 0; i < kCount; ++i) {
    const double u = random.Uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++bins[static_cast<std::size_t>(64.0 * u)];
  }
  double chi_square = 0.0;
  constexpr double kExpected = kCount / 64.0;
  for (const int count : bins) chi_square += std::pow(count - kExpected, 2) / kExpected;
  // 63 degrees of freedom: mean 63, standard deviation 11.2; five of them.
  EXPECT_LT(chi_square, 120.0);
  EXPECT_GT(chi_square, 20.0);  // too even would be wrong as well
}

TEST(Random, DrawsNormalNumbersWithTheTailsOfTheNormalDistribution) {
  Random random(2);
  std::array<int, 4> beyond{};
  for (int i = 0; i < kCount; ++i) {
    const double z = std::abs(random.Normal());
    for (std::size_t sigma = 1; sigma < 4; ++sigma) {
      if (z > static_cast<double>(sigma)) ++beyond[sigma];
    }
  }
  for (std::size_t sigma = 1; sigma < 4; ++sigma) {
    const double p = std::erfc(static_cast<double>(sigma) / std::sqrt(2.0));
    // Five standard errors of a count.
    EXPECT_NEAR(beyond[sigma], kCount * p, 5.0 * std::sqrt(kCount * p * (1.0 - p))) << sigma;
  }
}

TEST(Random, RemembersNothingFromOneNumberToTheNext) {
  // The polar method makes two normal numbers at a time; they must not know of each other, nor
  // their squares. Standard error of a correlation: 1/sqrt(n) = 1.6e-3; five of them.
  for (const std::size_t lag : {1U, 2U, 3U}) {
    Random random(3);
    std::array<double, 4> past{};
    for (auto& value : past) value = random.Normal();
    double product = 0.0;
    double squares = 0.0;
    for (int i = 0; i < kCount; ++i) {
      const double now = random.Normal();
      const double then = past[(static_cast<std::size_t>(i) + 4 - lag) % 4];
      product += now * then;
      squares += (now * now - 1.0) * (then * then - 1.0) / 2.0;
      past[static_cast<std::size_t>(i) % 4] = now;
    }
    EXPECT_NEAR(product / kCount, 0.0, 8e-3) << lag;
    EXPECT_NEAR(squares / kCount, 0.0, 8e-3) << lag;
  }
}

TEST(Random, GivesNeighbouringSeedsUnrelatedSequences) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random one(seed);
    Random next(seed + 1);
    int different = 0;
    for (int i = 0; i < 16; ++i) different += std::popcount(one.Bits() ^ next.Bits());
    // 1024 fair bits: 512, standard deviation 16; six of them for 200 draws.
    EXPECT_NEAR(different, 512, 96) << seed;
  }
}

TEST(Random, ContinuesACopyWhereTheOriginalStood) {
  Random random(4);
  (void)random.Normal();  // one of the pair is still to come
  Random copy = random;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(copy.Normal(), random.Normal());
}

}  // namespace
}  // namespace levitas
