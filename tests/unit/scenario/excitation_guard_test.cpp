#include "controller/scenario/excitation_guard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace levitas::scenario {
namespace {

constexpr double kGuardPeriod_s = 1e-4;
constexpr double kClearance_m = 200e-6;

GuardLimits TwoBearings() {
  GuardLimits limits;
  limits.axes = 4;
  limits.period_s = kGuardPeriod_s;
  limits.current_a = 2.0;
  limits.clearance_m = {kClearance_m, kClearance_m};
  return limits;
}

/// Currents after a cycle at these positions.
AxisArray Currents(ExcitationGuard& guard, const AxisArray& position_m, AxisArray current_a) {
  AxisArray shift_m{};
  guard.Limit(position_m, current_a, shift_m);
  return current_a;
}

std::uint64_t Cycles(const ExcitationGuard& guard, Reduced why) {
  return guard.counts().cycles[static_cast<std::size_t>(why)];
}

TEST(ExcitationGuard, LeavesAloneWhatStaysWithinTheShareOfEveryBearing) {
  ExcitationGuard guard(TwoBearings());
  const AxisArray asked_a{0.84, 0.84, -1.19, 0.0};  // 1.188 A and 1.19 A of 0.6 x 2 A
  for (int n = 0; n < 1000; ++n) EXPECT_EQ(Currents(guard, {}, asked_a), asked_a);
  GuardNotice notice;
  EXPECT_FALSE(guard.TakeNotice(notice));
}

TEST(ExcitationGuard, ScalesTheSumOfABearingToItsShareInItsDirection) {
  ExcitationGuard guard(TwoBearings());
  const AxisArray given_a = Currents(guard, {}, {3.0, 4.0, 0.1, 0.0});
  EXPECT_NEAR(given_a[0], 0.6 * 1.2, 1e-12);
  EXPECT_NEAR(given_a[1], 0.8 * 1.2, 1e-12);
  EXPECT_EQ(given_a[2], 0.1);
  EXPECT_EQ(Cycles(guard, Reduced::kCurrentSum), 1U);
}

TEST(ExcitationGuard, LimitsShiftsOfThePositionToAShareOfTheClearance) {
  ExcitationGuard guard(TwoBearings());
  AxisArray current_a{};
  AxisArray shift_m{0.0, 0.0, 0.0, -150e-6};
  guard.Limit({}, current_a, shift_m);
  EXPECT_NEAR(shift_m[3], -60e-6, 1e-15);
}

// Of 1.2 A and 60 um a bearing: 0.5 + 0.75 of the shares is a quarter too much, 0.5 + 0.5 is not.
TEST(ExcitationGuard, GivesCurrentsAndShiftsOfABearingOneShareTogether) {
  ExcitationGuard guard(TwoBearings());
  AxisArray current_a{0.6, 0.0, 0.0, 0.6};
  AxisArray shift_m{0.0, 45e-6, 30e-6, 0.0};
  guard.Limit({}, current_a, shift_m);
  EXPECT_NEAR(current_a[0], 0.6 / 1.25, 1e-12);
  EXPECT_NEAR(shift_m[1], 45e-6 / 1.25, 1e-15);
  EXPECT_EQ(current_a[3], 0.6);
  EXPECT_EQ(shift_m[2], 30e-6);
  EXPECT_EQ(Cycles(guard, Reduced::kCurrentSum), 1U);
  EXPECT_EQ(Cycles(guard, Reduced::kShiftSum), 1U);
}

TEST(ExcitationGuard, CutsEverythingOffInTheCycleInWhichTheRotorIsFarOut) {
  ExcitationGuard guard(TwoBearings());
  EXPECT_EQ(Currents(guard, {0.0, 0.0, 148e-6, 0.0}, {0.5, 0.0, 0.0, 0.0})[0], 0.5);
  ExcitationGuard other(TwoBearings());
  EXPECT_EQ(Currents(other, {0.0, 0.0, 0.0, -151e-6}, {0.5, 0.0, 0.0, 0.0})[0], 0.0);
}

TEST(ExcitationGuard, CutsOffBeforeThePlaceWhereTheRotorIsHeadedToIsReached) {
  ExcitationGuard guard(TwoBearings());
  double radius_m = 0.0;
  double given_a = 0.5;
  for (int n = 0; n < 1000 && given_a != 0.0; ++n) {  // 20 mm/s outwards: 40 um in 2 ms
    radius_m += 0.02 * kGuardPeriod_s;
    given_a = Currents(guard, {radius_m, 0.0, 0.0, 0.0}, {0.5, 0.0, 0.0, 0.0})[0];
  }
  EXPECT_EQ(given_a, 0.0);
  // 150 um - 2 ms x 20 mm/s, to within a period's way; the velocity's filter has long settled.
  EXPECT_NEAR(radius_m, 110e-6, 4e-6);
}

TEST(ExcitationGuard, LooksHalfAsFarAheadWhereOnlyThePositionIsShifted) {
  ExcitationGuard guard(TwoBearings());
  double radius_m = 0.0;
  double given_m = 10e-6;
  for (int n = 0; n < 1000 && given_m != 0.0; ++n) {
    radius_m += 0.02 * kGuardPeriod_s;
    AxisArray current_a{};
    AxisArray shift_m{10e-6};
    guard.Limit({radius_m}, current_a, shift_m);
    given_m = shift_m[0];
  }
  EXPECT_NEAR(radius_m, 130e-6, 4e-6);  // 150 um - 1 ms x 20 mm/s
}

TEST(ExcitationGuard, ComesBackSlowlyAndSaysTheCutOnce) {
  ExcitationGuard guard(TwoBearings());
  const AxisArray asked_a{0.5, 0.0, 0.0, 0.0};
  EXPECT_EQ(Currents(guard, {170e-6, 0.0, 0.0, 0.0}, asked_a)[0], 0.0);
  double given_a = 0.0;
  for (int n = 0; n < 10'000; ++n) given_a = Currents(guard, {}, asked_a)[0];
  EXPECT_NEAR(given_a, 0.5 * (1.0 - std::exp(-1.0)), 2e-3);  // one time constant, less the filter's
  GuardNotice notice;
  ASSERT_TRUE(guard.TakeNotice(notice));
  EXPECT_EQ(notice.why, Reduced::kRadius);
  EXPECT_EQ(notice.bearing, 0U);
  EXPECT_NEAR(notice.asked, 0.85, 1e-12);
  EXPECT_FALSE(guard.TakeNotice(notice));
}

TEST(ExcitationGuard, TakesNothingFromASignalThatBeginsLongAfterTheRotorLayInItsBearings) {
  ExcitationGuard guard(TwoBearings());
  for (int n = 0; n < 100; ++n) (void)Currents(guard, {0.0, -200e-6, 0.0, 0.0}, {});
  for (int n = 0; n < 100; ++n) (void)Currents(guard, {}, {});
  EXPECT_EQ(Currents(guard, {}, {0.5, 0.0, 0.0, 0.0})[0], 0.5);
}

TEST(ExcitationGuard, CutsOffForAPositionThatIsNoNumberAndRecoversFromIt) {
  ExcitationGuard guard(TwoBearings());
  const AxisArray asked_a{0.5, 0.0, 0.0, 0.0};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Currents(guard, {0.0, nan, 0.0, 0.0}, asked_a)[0], 0.0);
  double given_a = 0.0;
  for (int n = 0; n < 60'000; ++n) given_a = Currents(guard, {}, asked_a)[0];
  EXPECT_EQ(given_a, 0.5);
}

TEST(ExcitationGuard, WithoutAxesDoesNothing) {
  ExcitationGuard guard(GuardLimits{});
  EXPECT_EQ(Currents(guard, {1.0}, {9.0})[0], 9.0);
}

TEST(ExcitationGuard, SaysInOneSentenceWhatItTookAndWhy) {
  RigNumbers rig;
  rig.bearings = {"de", "nde"};
  EXPECT_EQ(Text({Reduced::kCurrentSum, 1, 1.414, 0.6}, rig),
            "test signals reduced: together they ask for 1.41 A in bearing nde, 0.6 A is the share "
            "of what the coils leave; the law needs the rest");
  EXPECT_EQ(
      Text({Reduced::kRadius, 0, 0.85, 0.75}, rig),
      "test signals cut off: the rotor is or will be within milliseconds at 85 % of the clearance "
      "of bearing de, 75 % are allowed; they come back within seconds");
}

}  // namespace
}  // namespace levitas::scenario
