// The cycle in which an event is first seen.

#include "plant_sim/events/cycle_at.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace levitas::events {
namespace {

TEST(CycleAt, IsTheCycleThatBeginsAtTheTime) {
  EXPECT_EQ(CycleAt(0.0, 1e-4), 0U);
  EXPECT_EQ(CycleAt(1.0, 1e-4), 10000U);
  EXPECT_EQ(CycleAt(0.25, 1.0 / 20000.0), 5000U);
}

TEST(CycleAt, IsNeverACycleThatBeginsBeforeTheTime) {
  EXPECT_EQ(CycleAt(1.00001e-2, 1e-4), 101U);
  EXPECT_EQ(CycleAt(1.00999e-2, 1e-4), 101U);
}

// A time read from a file is rounded, and so is its quotient: for many cycles it comes out a
// little above the whole number, and the next cycle would be one too late.
TEST(CycleAt, ForgivesTheRoundingOfTheQuotient) {
  int above = 0;
  for (const double rate_hz : {5000.0, 10000.0, 16000.0, 30000.0}) {
    const double period_s = 1.0 / rate_hz;
    for (std::uint64_t cycle = 0; cycle < 100000; ++cycle) {
      const double time_s = static_cast<double>(cycle) * period_s;
      const double decimal_s = std::round(time_s * 1e9) * 1e-9;
      above += decimal_s / period_s > static_cast<double>(cycle) ? 1 : 0;
      ASSERT_EQ(CycleAt(time_s, period_s), cycle) << time_s;
      if (rate_hz != 30000.0) {
        ASSERT_EQ(CycleAt(decimal_s, period_s), cycle) << decimal_s;
      }
    }
  }
  EXPECT_GT(above, 0) << "no quotient was above: the test shows nothing";
}

TEST(CycleAt, TakesATimeBeforeTheRunAsItsBeginning) { EXPECT_EQ(CycleAt(-3.0, 1e-4), 0U); }

}  // namespace
}  // namespace levitas::events
