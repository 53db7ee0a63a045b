// Synchronous control on the nonlinear rig, with noise: what it takes away, and that it takes it
// away without a trip.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/loop/synchronous/notch_loop.hpp"

namespace levitas::test {
namespace {

using synchronous::BlockState;
using synchronous::Target;

class Rejection : public testing::TestWithParam<double> {};

TEST_P(Rejection, TakesTheSynchronousCurrentAway) {
  const double rpm = GetParam();
  ClosedLoop plain(CommissionedCycle());
  ASSERT_TRUE(TurnsAt(plain, rpm, 3.0));
  const Turning before = Measure(plain, 100);
  ClosedLoop quiet(WithBlock(Asked(Target::kCurrent, 1500.0, 6000.0)));
  ASSERT_TRUE(TurnsAt(quiet, rpm, 5.0));
  EXPECT_EQ(quiet.out.synchronous[0].state, BlockState::kActing);
  const Turning after = Measure(quiet, 100);
  EXPECT_LT(Decibel(after.current_a, before.current_a), -40.0)
      << before.current_a << " A to " << after.current_a << " A";
  RecordProperty("current_db", std::to_string(Decibel(after.current_a, before.current_a)));
}

TEST_P(Rejection, TakesTheSynchronousVibrationAway) {
  const double rpm = GetParam();
  ClosedLoop plain(CommissionedCycle());
  ASSERT_TRUE(TurnsAt(plain, rpm, 3.0));
  const Turning before = Measure(plain, 100);
  ClosedLoop still(WithBlock(Asked(Target::kVibration, 1500.0, 6000.0)));
  ASSERT_TRUE(TurnsAt(still, rpm, 5.0));
  EXPECT_EQ(still.out.synchronous[0].state, BlockState::kActing)
      << static_cast<int>(still.out.synchronous[0].ending);
  const Turning after = Measure(still, 100);
  EXPECT_LT(Decibel(after.position_m, before.position_m), -40.0)
      << 1e6 * before.position_m << " um to " << 1e6 * after.position_m << " um, amplitude "
      << still.out.synchronous[0].amplitude << " A";
}

INSTANTIATE_TEST_SUITE_P(AtTheSpeedsOfTheRig, Rejection, testing::Values(1600.0, 3000.0, 6000.0));

}  // namespace
}  // namespace levitas::test
