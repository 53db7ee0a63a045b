#include "controller/scenario/prbs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace levitas::scenario {
namespace {

std::vector<int> OnePeriod(int order) {
  Prbs sequence(order);
  std::vector<int> bits(sequence.period());
  for (int& bit : bits) bit = sequence.Next() ? 1 : -1;
  return bits;
}

class PrbsOrder : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(All, PrbsOrder, testing::Range(2, 24));

TEST_P(PrbsOrder, HoldsOneMoreOneThanZeros) {
  const std::vector<int> bits = OnePeriod(GetParam());
  EXPECT_EQ(bits.size(), (std::size_t{1} << GetParam()) - 1);
  EXPECT_EQ(std::accumulate(bits.begin(), bits.end(), 0), 1);  // closed form of a full-length cycle
}

TEST_P(PrbsOrder, RepeatsAfterItsPeriodAndNotBefore) {
  // A register of n bits is back in its state when n consecutive outputs repeat those at the start.
  const int order = GetParam();
  Prbs sequence(order);
  const std::uint32_t period = sequence.period();
  const std::uint32_t mask = period;
  std::uint32_t window = 0;
  for (int i = 0; i < order; ++i) window = (window << 1U | (sequence.Next() ? 1U : 0U)) & mask;
  const std::uint32_t first = window;
  std::uint32_t steps = 0;
  do {
    window = (window << 1U | (sequence.Next() ? 1U : 0U)) & mask;
    ++steps;
  } while (window != first && steps <= period);
  EXPECT_EQ(steps, period);
}

TEST(Prbs, IsUncorrelatedWithEveryShiftOfItself) {
  for (const int order : {7, 8, 9, 10}) {
    const std::vector<int> bits = OnePeriod(order);
    for (std::size_t lag = 1; lag < bits.size(); ++lag) {
      int sum = 0;
      for (std::size_t i = 0; i < bits.size(); ++i) sum += bits[i] * bits[(i + lag) % bits.size()];
      ASSERT_EQ(sum, -1) << "order " << order << " lag " << lag;  // closed form
    }
  }
}

TEST(Prbs, LongestRunIsTheOrder) {
  const std::vector<int> bits = OnePeriod(11);
  int longest = 0;
  int run = 0;
  for (std::size_t i = 0; i < 2 * bits.size(); ++i) {
    run = bits[i % bits.size()] == 1 ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  EXPECT_EQ(longest, 11);  // Golomb: one run of n ones
}

TEST(Prbs, StartsTheGivenFractionIntoThePeriod) {
  Prbs whole(10);
  for (int i = 0; i < 255; ++i) (void)whole.Next();  // floor(0.25 x 1023)
  Prbs quarter(10, 0.25);
  for (int i = 0; i < 1023; ++i) ASSERT_EQ(quarter.Next(), whole.Next()) << i;
}

TEST(Prbs, TakesTheNearestOrderForOneThatIsNotOffered) {
  EXPECT_EQ(Prbs(1).period(), 3U);
  EXPECT_EQ(Prbs(40).period(), (1U << 31U) - 1U);
}

// Orders whose period is too long to be walked through: a register is back after 2^n - 1 steps and,
// for no prime factor p of that, after (2^n - 1)/p already. That makes 2^n - 1 its period.
TEST(Prbs, LongOrdersHaveTheirFullPeriodToo) {
  const auto same = [](Prbs a, Prbs b) {
    for (int i = 0; i < 64; ++i) {
      if (a.Next() != b.Next()) return false;
    }
    return true;
  };
  for (int order = 2; order <= Prbs::kHighestOrder; ++order) {
    const Prbs start(order);
    Prbs after = start;
    after.Skip(start.period());
    EXPECT_TRUE(same(start, after)) << order;
    std::uint32_t rest = start.period();
    for (std::uint32_t p = 2; rest > 1; ++p) {
      if (std::uint64_t{p} * p > rest) p = rest;  // what is left is prime
      if (rest % p != 0) continue;
      while (rest % p == 0) rest /= p;
      Prbs early = start;
      early.Skip(start.period() / p);
      EXPECT_FALSE(same(start, early)) << order << ", factor " << p;
    }
  }
}

TEST(Prbs, StartsWithTheBitsOfItsRegister) {
  constexpr std::uint32_t kBits = 0b101'1001'0110;
  Prbs sequence = Prbs::FromRegister(11, kBits);
  for (int i = 10; i >= 0; --i) EXPECT_EQ(sequence.Next(), ((kBits >> i) & 1U) != 0) << i;
  // x^11 + x^9 + 1: the next bit is the sum of those 11 and 9 places back.
  EXPECT_EQ(sequence.Next(), (((kBits >> 10) ^ (kBits >> 8)) & 1U) != 0);
}

TEST(Prbs, WithoutAOneInTheRegisterStartsAtTheBeginning) {
  Prbs empty = Prbs::FromRegister(5, 0b100000);  // beyond its five bits
  Prbs first(5);
  for (int i = 0; i < 31; ++i) EXPECT_EQ(empty.Next(), first.Next());
}

}  // namespace
}  // namespace levitas::scenario
