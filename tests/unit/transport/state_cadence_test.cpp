#include "transport/state_cadence.hpp"

#include <gtest/gtest.h>

namespace levitas::transport {
namespace {

TEST(StateCadence, IsAHundredStatesASecondOfEveryLoopThatIsFaster) {
  for (const std::int64_t rate_hz : {100, 1'000, 10'000, 12'500, 20'000}) {
    const std::uint64_t cycles = CyclesPerState(1'000'000'000 / rate_hz);
    EXPECT_EQ(static_cast<std::int64_t>(cycles) * 100, rate_hz);
  }
}

TEST(StateCadence, IsEveryCycleOfASlowerLoopAndOfOneWithoutPeriod) {
  EXPECT_EQ(CyclesPerState(50'000'000), 1U);
  EXPECT_EQ(CyclesPerState(0), kStateEveryNs);
}

}  // namespace
}  // namespace levitas::transport
