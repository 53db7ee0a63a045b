#include <gtest/gtest.h>

#include "programs/controller/delay_watch.hpp"

namespace levitas::controller_program {
namespace {

can_port::DelayFigures Measured(double median_periods) {
  return {.count = 20'000,
          .least_periods = median_periods - 0.1,
          .median_periods = median_periods,
          .p99_periods = median_periods + 0.1,
          .most_periods = median_periods + 0.2};
}

TEST(DelayObjection, IsNoneWithinTheToleranceOnEitherSide) {
  EXPECT_EQ(DelayObjection(Measured(1.0), 1.0), "");
  EXPECT_EQ(DelayObjection(Measured(1.0), 1.0 + DelayWatch::kTolerance), "");
  EXPECT_EQ(DelayObjection(Measured(1.0), 1.0 - DelayWatch::kTolerance), "");
}

TEST(DelayObjection, NamesBothDelaysTheCountAndTheKeysToCorrect) {
  for (const double taken : {1.0, 2.0}) {
    const std::string text = DelayObjection(Measured(1.5), taken);
    for (const char* part : {"1.50", "20000", "delay_samples", "current_acts"}) {
      EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
    }
    EXPECT_NE(text.find(taken == 1.0 ? "take 1.00" : "take 2.00"), std::string::npos) << text;
  }
}

TEST(DelayObjection, IsNoneWhereNothingWasMeasured) { EXPECT_EQ(DelayObjection({}, 1.0), ""); }

}  // namespace
}  // namespace levitas::controller_program
