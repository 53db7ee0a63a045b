// The shipped rig with a bias that falls while little is asked for: what it saves, that nobody
// notices, and what would happen if it were not raised in time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/loop/levitation/closed_loop.hpp"

namespace levitas::test {
namespace {

cycle::CycleConfig Saving() {
  cycle::CycleConfig config = CommissionedCycle();
  config.bias.lowest_current_a = 0.2;
  return config;
}

/// Mean square of all coil currents [A^2], which copper turns into heat.
double Heat(ClosedLoop& loop, double seconds) {
  double sum = 0.0;
  const auto periods = std::lround(seconds / ShippedRig().numbers.period_s());
  for (long n = 0; n < periods; ++n) {
    (void)loop.Step();
    const double bias_a = loop.out.current.bias_current_a;
    for (std::size_t i = 0; i < 4; ++i) {
      sum += bias_a * bias_a + std::pow(loop.out.current.control_current_a[i], 2);
    }
  }
  return sum / (4.0 * static_cast<double>(periods));
}

TEST(BiasSavingPair, HeatsTheCoilsLessAtTheSameOrbit) {
  ClosedLoop plain(CommissionedCycle());
  ClosedLoop saving(Saving());
  for (ClosedLoop* loop : {&plain, &saving}) {
    ASSERT_TRUE(loop->Levitate());
    loop->SpinAt(1600.0);
    loop->Run(4.0);
    loop->Reset();
  }
  const double before = Heat(plain, 1.0);
  const double after = Heat(saving, 1.0);
  EXPECT_EQ(plain.out.current.bias_current_a, ShippedRig().numbers.bias_current_a);
  EXPECT_LT(after, 0.7 * before) << saving.out.current.bias_current_a << " A";
  EXPECT_LT(saving.most.orbit_m, 1.1 * plain.most.orbit_m);
}

// Falling and rising is no step: what moves is a current, not the force.
TEST(BiasSavingPair, ChangesTheBiasWithoutMovingTheRotor) {
  ClosedLoop plain(CommissionedCycle());
  ClosedLoop saving(Saving());
  double lowest_a = 1e9;
  for (ClosedLoop* loop : {&plain, &saving}) {
    ASSERT_TRUE(loop->Levitate());
    loop->Run(1.0);
    loop->Reset();
    loop->Run(4.0);
    lowest_a = std::min(lowest_a, loop->out.current.bias_current_a);
    loop->Command(OperatorCommand::kSpin, 600.0, 800.0);  // the whole bias, in milliseconds
    loop->Run(0.1);
    EXPECT_EQ(loop->out.current.bias_current_a, ShippedRig().numbers.bias_current_a);
  }
  EXPECT_LT(lowest_a, 0.7 * ShippedRig().numbers.bias_current_a);
  EXPECT_LT(saving.most.orbit_m, 1.2 * plain.most.orbit_m);
}

}  // namespace
}  // namespace levitas::test
