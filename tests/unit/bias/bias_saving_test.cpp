#include "controller/bias/bias_saving.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "plant_sim/magnet/magnet.hpp"
#include "tests/support/allocation_guard.hpp"

namespace levitas::bias {
namespace {

RigNumbers Rig() {
  RigNumbers rig;
  rig.channels = {"x", "y"};
  rig.bearings = {"b"};
  rig.bias_current_a = 2.0;
  rig.max_coil_current_a = 5.0;
  rig.clearance_m = 200e-6;
  rig.magnet_gaps_m = {500e-6};
  return rig;
}

BiasConfig Saving() {
  BiasConfig config;
  config.lowest_current_a = 0.4;
  config.largest_share = 0.5;
  config.largest_orbit_fraction = 0.2;
  config.lowering_time_s = 1.0;
  config.raising_time_s = 0.005;
  return config;
}

Conditions Calm() { return {.levitated = true}; }

void Go(BiasSaving& saving, double seconds, const Conditions& seen, const AxisArray& law_a) {
  const auto periods = std::lround(seconds / Rig().period_s());
  for (long n = 0; n < periods; ++n) saving.Step(seen, law_a);
}

// The two constants of a magnet at a bias are those of the simulated magnet, not of this code.
TEST(BiasShare, KeepsTheForceOfTheLinearMagnetAtEveryBias) {
  magnet::Magnet m;
  m.force_constant_n_m2_per_a2 = 2.1e-6;
  m.gap_m = 500e-6;
  m.max_coil_current_a = 5.0;
  const double i0 = 2.0;
  const double ic_a = 0.13;
  const double x_m = -21e-6;
  const double meant_n =
      magnet::ForcePerCurrent(m, i0) * ic_a + magnet::NegativeStiffness(m, i0) * x_m;
  for (const double bias_a : {2.0, 1.1, 0.6, 0.2}) {
    const Share share = ShareAt(i0, bias_a, m.gap_m);
    const double ib_a = share.current * ic_a + share.displacement_a_per_m * x_m;
    EXPECT_NEAR(
        magnet::ForcePerCurrent(m, bias_a) * ib_a + magnet::NegativeStiffness(m, bias_a) * x_m,
        meant_n, 1e-12 * std::abs(meant_n))
        << bias_a;
  }
}

TEST(BiasSaving, IsNothingWithoutALowestCurrent) {
  BiasSaving none({}, Rig());
  const AxisArray law_a{0.1, -0.2};
  Go(none, 1.0, Calm(), law_a);
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.current_a(), 2.0);
  EXPECT_EQ(none.At(law_a, {1e-5, 2e-5}), law_a);
  EXPECT_EQ(none.LimitOf(1.5, {1e-5, 2e-5}), 1.5);
}

TEST(BiasSaving, FallsToTheLowestWhereNothingIsAskedFor) {
  BiasSaving saving(Saving(), Rig());
  EXPECT_EQ(saving.current_a(), 2.0);
  Go(saving, 0.4, Calm(), {});
  EXPECT_NEAR(saving.current_a(), 1.2, 1e-3) << "2 A in a second";
  Go(saving, 1.0, Calm(), {});
  EXPECT_EQ(saving.current_a(), 0.4);
}

TEST(BiasSaving, LeavesTheShareThatIsKeptForAShock) {
  BiasSaving saving(Saving(), Rig());
  Conditions seen = Calm();
  seen.position_m = {10e-6, -5e-6};
  const AxisArray law_a{0.05, -0.2};
  Go(saving, 3.0, seen, law_a);
  EXPECT_LT(saving.current_a(), 2.0);
  EXPECT_GT(saving.current_a(), 0.4);
  const AxisArray out_a = saving.At(law_a, seen.position_m);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LE(std::abs(out_a[i]), 0.5 * saving.current_a());
}

TEST(BiasSaving, IsWholeAgainWithinTheRaisingTimeOfALargeCurrent) {
  BiasSaving saving(Saving(), Rig());
  Go(saving, 3.0, Calm(), {});
  ASSERT_EQ(saving.current_a(), 0.4);
  Go(saving, 0.0045, Calm(), {1.2, 0.0});
  EXPECT_EQ(saving.current_a(), 2.0);
}

TEST(BiasSaving, IsWholeBeforeItMayBeNeeded) {
  const auto raised = [](const Conditions& seen) {
    BiasSaving saving(Saving(), Rig());
    Go(saving, 3.0, Calm(), {});
    EXPECT_EQ(saving.current_a(), 0.4);
    Go(saving, 0.0045, seen, {});
    return saving.current_a();
  };
  EXPECT_EQ(raised(Calm()), 0.4);
  Conditions landing = Calm();
  landing.levitated = false;
  EXPECT_EQ(raised(landing), 2.0);
  Conditions speeding = Calm();
  speeding.speed_changes = true;
  EXPECT_EQ(raised(speeding), 2.0);
  Conditions excited = Calm();
  excited.excited = true;
  EXPECT_EQ(raised(excited), 2.0);
  Conditions limited = Calm();
  limited.saturated_axes = 2;
  EXPECT_EQ(raised(limited), 2.0);
  // A fifth of 200 um; inside it the pull towards the magnet raises the bias by its share only.
  Conditions inside = Calm();
  inside.position_m = {28e-6, 28e-6};
  EXPECT_LT(raised(inside), 1.0);
  Conditions outside = Calm();
  outside.position_m = {29e-6, 29e-6};
  EXPECT_EQ(raised(outside), 2.0);
  outside.reference_m = {29e-6, 29e-6};
  EXPECT_LT(raised(outside), 1.0) << "the orbit counts from where the law is asked to hold";
  Conditions unknown = Calm();
  unknown.position_m[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(raised(unknown), 2.0);
}

TEST(BiasSaving, IsWholeBeyondTheOrbitOfARigOfOneAxisToo) {
  RigNumbers rig = Rig();
  rig.channels = {"x"};
  BiasSaving saving(Saving(), rig);
  Go(saving, 3.0, Calm(), {});
  ASSERT_EQ(saving.current_a(), 0.4);
  Conditions outside = Calm();
  outside.position_m[0] = 41e-6;
  Go(saving, 0.0045, outside, {});
  EXPECT_EQ(saving.current_a(), 2.0);
}

TEST(BiasSaving, KeepsBothCoilsAboveNothing) {
  BiasSaving saving(Saving(), Rig());
  Go(saving, 3.0, Calm(), {});
  const AxisArray out_a = saving.At({1.9, -1.9}, {});
  EXPECT_EQ(out_a[0], 0.4);
  EXPECT_EQ(out_a[1], -0.4);
  // A law current at the limit that the law is given becomes a control current at the coils' limit.
  const AxisArray read_m{15e-6, 0.0};
  const double limit_a = saving.LimitOf(2.0, read_m);
  const AxisArray at_limit_a = saving.At({limit_a, limit_a}, read_m);
  EXPECT_NEAR(at_limit_a[0], 0.4, 1e-12);
  EXPECT_LT(at_limit_a[1], 0.4);
}

TEST(BiasSaving, BeginsWithTheWholeBiasAfterAReset) {
  BiasSaving saving(Saving(), Rig());
  Go(saving, 3.0, Calm(), {});
  saving.Reset();
  EXPECT_EQ(saving.current_a(), 2.0);
  EXPECT_EQ(saving.At({0.3, 0.1}, {1e-5, 1e-5}), (AxisArray{0.3, 0.1}));
}

TEST(BiasSaving, AllocatesNothing) {
  BiasSaving saving(Saving(), Rig());
  const test::AllocationGuard guard;
  saving.Step(Calm(), {0.1, 0.0});
  (void)saving.At({0.1, 0.0}, {});
  (void)saving.LimitOf(2.0, {});
  EXPECT_EQ(guard.count(), 0U);
}

TEST(BiasSaving, RefusesARigThatItsEquationDoesNotHoldFor) {
  RigNumbers rig = Rig();
  rig.magnet_gaps_m.clear();
  EXPECT_THROW(BiasSaving(Saving(), rig), std::invalid_argument);
  EXPECT_NO_THROW(BiasSaving({}, rig));
  BiasConfig high = Saving();
  high.lowest_current_a = 2.0;
  EXPECT_THROW(BiasSaving(high, Rig()), std::invalid_argument);
}

}  // namespace
}  // namespace levitas::bias
