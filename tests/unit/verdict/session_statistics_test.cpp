#include "verdict/session_statistics.hpp"
#include "common/rotational_speed.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/verdict/synthetic_session.hpp"

namespace levitas::verdict {
namespace {

// Whole turns of equally spaced points: the closed forms hold to rounding, 1e-12 of the value.
constexpr int kTurns = 5 * SyntheticSession::kCyclesPerTurn;
constexpr double kRounding_m = 1e-16;

TEST(SessionStatistics, ACircleHasItsRadiusAsMaximumAndRms) {
  SyntheticSession session;
  session.Append(Mode::kLevitating, kTurns, {.radius_m = 5e-6});
  const SessionFigures figures = session.Figures(TwoBearingRig());
  ASSERT_EQ(figures.standing.bearings.size(), 2U);
  for (const BearingFigures& bearing : figures.standing.bearings) {
    EXPECT_NEAR(bearing.orbit.max_m, 5e-6, kRounding_m);
    EXPECT_NEAR(bearing.orbit.rms_m, 5e-6, kRounding_m);
    EXPECT_NEAR(bearing.orbit.offset_x_m, 0.0, kRounding_m);
    EXPECT_NEAR(bearing.orbit.offset_y_m, 0.0, kRounding_m);
  }
  EXPECT_EQ(figures.standing.cycles, static_cast<std::uint64_t>(kTurns));
  EXPECT_EQ(figures.spinning.cycles, 0U);
}

// Circle of radius r about (a, b), |(a, b)| = d along the 3-4-5 direction, which is not on the
// 200-point grid: the largest radius is r + d less the sagitta of half a step; rms = sqrt(r^2+d^2).
TEST(SessionStatistics, AnOffsetCountsInMaximumAndRms) {
  SyntheticSession session;
  session.Append(Mode::kLevitating, kTurns,
                 {.radius_m = 2e-6, .offset_x_m = 3e-6, .offset_y_m = -4e-6});
  const auto orbit = session.Figures(TwoBearingRig()).standing.bearings[1].orbit;
  const double half_step = 0.5 * kTwoPi / SyntheticSession::kCyclesPerTurn;
  EXPECT_LE(orbit.max_m, 7e-6 + kRounding_m);
  EXPECT_GE(orbit.max_m, 7e-6 - 2e-6 * half_step * half_step);
  EXPECT_NEAR(orbit.rms_m, std::sqrt(4.0 + 25.0) * 1e-6, kRounding_m);
  EXPECT_NEAR(orbit.offset_x_m, 3e-6, kRounding_m);
  EXPECT_NEAR(orbit.offset_y_m, -4e-6, kRounding_m);
}

TEST(SessionStatistics, UndoesThePolarityOfProbesAndAmplifiers) {
  RigNumbers rig = TwoBearingRig();
  rig.sensor_polarity[0] = -1.0;
  rig.actuator_polarity[3] = -1.0;
  SyntheticSession session;
  session.Append(Mode::kLevitating, kTurns, {.offset_x_m = 1e-6, .static_a = 0.2});
  const SessionFigures figures = session.Figures(rig);
  EXPECT_NEAR(figures.standing.bearings[0].orbit.offset_x_m, -1e-6, kRounding_m);
  EXPECT_NEAR(figures.standing.bearings[1].orbit.offset_x_m, 1e-6, kRounding_m);
  EXPECT_NEAR(figures.standing.bearings[1].current[0].mean_a, 0.2, 1e-12);
  EXPECT_NEAR(figures.standing.bearings[1].current[1].mean_a, -0.2, 1e-12);
}

// i = s + a cos: mean s, rms about the mean a/sqrt(2), peak |s| + a.
TEST(SessionStatistics, SplitsTheCurrentIntoStaticAndDynamicPart) {
  SyntheticSession session;
  session.Append(Mode::kLevitating, kTurns, {.static_a = -0.3, .amplitude_a = 0.1});
  const CurrentFigures current = session.Figures(TwoBearingRig()).standing.bearings[0].current[0];
  EXPECT_NEAR(current.mean_a, -0.3, 1e-12);
  EXPECT_NEAR(current.dynamic_rms_a, 0.1 / std::sqrt(2.0), 1e-9);  // difference of two squares
  EXPECT_NEAR(current.peak_a, 0.4, 1e-12);
  EXPECT_EQ(current.saturated_share, 0.0);
}

// Half the cycles at the rig's bias, half at half of it, i = 0.2 cos on all four axes:
// (1 + 1/4)/2 + (0.2/2)^2/2 of the square of the bias.
TEST(SessionStatistics, CountsWhatTheCoilsHeatWithAtALowerBias) {
  RigNumbers rig = TwoBearingRig();
  rig.bias_current_a = 2.0;
  SyntheticSession session;
  int count = 0;
  session.Append(Mode::kLevitating, 2 * kTurns, {.amplitude_a = 0.2},
                 [&](cycle::CycleRecord& record) {
                   record.out.current.bias_current_a = count++ < kTurns ? 2.0 : 1.0;
                 });
  const PhaseFigures standing = session.Figures(rig).standing;
  EXPECT_NEAR(standing.mean_bias_a, 1.5, 1e-12);
  EXPECT_NEAR(standing.copper_share, 0.625 + 0.005, 1e-9);
}

TEST(SessionStatistics, CountsTheShareOfSaturatedCyclesPerAxisAndOverall) {
  SyntheticSession session;
  int count = 0;
  session.Append(Mode::kSpinning, 1000, {.speed_rad_per_s = 10.0}, [&](cycle::CycleRecord& record) {
    const int i = count++;
    if (i < 100) record.out.saturated_axes |= 1U << 1;             // de_y
    if (i >= 50 && i < 300) record.out.saturated_axes |= 1U << 2;  // nde_x
  });
  const PhaseFigures spinning = session.Figures(TwoBearingRig()).spinning;
  EXPECT_DOUBLE_EQ(spinning.bearings[0].current[0].saturated_share, 0.0);
  EXPECT_DOUBLE_EQ(spinning.bearings[0].current[1].saturated_share, 0.1);
  EXPECT_DOUBLE_EQ(spinning.bearings[1].current[0].saturated_share, 0.25);
  EXPECT_DOUBLE_EQ(spinning.saturated_share, 0.3);
}

TEST(SessionStatistics, SaysAtWhichSpeedAndTimeTheOrbitWasWorst) {
  SyntheticSession session;
  session.Append(Mode::kLevitating, 100, {.radius_m = 1e-6});
  session.Append(Mode::kSpinning, 100, {.radius_m = 4e-6, .speed_rad_per_s = 100.0});
  session.Append(Mode::kSpinning, 100, {.radius_m = 9e-6, .speed_rad_per_s = 200.0});
  session.Append(Mode::kCoastDown, 100, {.radius_m = 8e-6, .speed_rad_per_s = 100.0});
  const SessionFigures figures = session.Figures(TwoBearingRig());
  const OrbitFigures& orbit = figures.spinning.bearings[0].orbit;
  EXPECT_NEAR(orbit.max_m, 9e-6, kRounding_m);
  EXPECT_EQ(orbit.max_speed_rad_per_s, 200.0);
  EXPECT_GE(orbit.max_time_s, 0.02 - 1e-9);  // cycles 200 .. 299 of 100 us
  EXPECT_LT(orbit.max_time_s, 0.03 - 1e-9);
  EXPECT_EQ(figures.top_speed_rad_per_s, 200.0);
}

// Bins are 50 rpm wide: 10 rpm lies in [0, 50), 120 rpm in [100, 150), nothing between.
TEST(SessionStatistics, KeepsTheLargestOrbitOfEachSpeedBin) {
  SyntheticSession session;
  session.Append(Mode::kSpinning, 200, {.radius_m = 2e-6, .speed_rad_per_s = RpmToRadPerS(10.0)});
  session.Append(Mode::kSpinning, 200, {.radius_m = 6e-6, .speed_rad_per_s = RpmToRadPerS(120.0)});
  session.Append(Mode::kCoastDown, 200, {.radius_m = 3e-6, .speed_rad_per_s = RpmToRadPerS(20.0)});
  const SessionFigures figures = session.Figures(TwoBearingRig(), 0.0, 0.1);
  ASSERT_EQ(figures.profile.size(), 2U);
  EXPECT_NEAR(figures.profile[0].speed_rad_per_s, RpmToRadPerS(25.0), 1e-9);
  EXPECT_NEAR(figures.profile[0].max_m[0], 3e-6, kRounding_m);
  EXPECT_EQ(figures.profile[0].cycles, 400U);
  EXPECT_NEAR(figures.profile[1].speed_rad_per_s, RpmToRadPerS(125.0), 1e-9);
  EXPECT_NEAR(figures.profile[1].max_m[1], 6e-6, kRounding_m);
}

TEST(SessionStatistics, JudgesNeitherLiftNorSettlingNorLanding) {
  SyntheticSession session;
  session.Append(Mode::kOff, 50, {.radius_m = 190e-6});
  session.Append(Mode::kLift, 50, {.radius_m = 150e-6});
  session.Append(Mode::kLevitating, 100, {.radius_m = 50e-6});  // 10 ms of settling
  session.Append(Mode::kLevitating, 200, {.radius_m = 2e-6});
  session.Append(Mode::kLanding, 50, {.radius_m = 180e-6});
  const SessionFigures figures = session.Figures(TwoBearingRig(), 0.010);
  EXPECT_NEAR(figures.standing.bearings[0].orbit.max_m, 2e-6, kRounding_m);
  EXPECT_EQ(figures.standing.cycles, 200U);
  EXPECT_NEAR(figures.standing.duration_s, 0.02, 1e-12);
}

TEST(SessionStatistics, ListsTheModesWithTheirTimes) {
  SyntheticSession session;
  session.Append(Mode::kOff, 10);
  session.Append(Mode::kSelfTest, 20);
  session.Append(Mode::kLift, 30);
  const SessionFigures figures = session.Figures(TwoBearingRig());
  ASSERT_EQ(figures.modes.size(), 3U);
  EXPECT_EQ(figures.modes[1].mode, Mode::kSelfTest);
  EXPECT_NEAR(figures.modes[1].start_s, 0.001, 1e-12);
  EXPECT_NEAR(figures.modes[1].duration_s, 0.002, 1e-12);
  EXPECT_NEAR(figures.duration_s, 0.006, 1e-12);
}

TEST(SessionStatistics, KeepsTheFirstTripAndCountsThemAll) {
  SyntheticSession session;
  session.Append(Mode::kSpinning, 10, {.speed_rad_per_s = 50.0});
  const auto trip = [](cycle::CycleRecord& record) {
    record.out.fault = Fault::kOrbitExceeded;
    record.out.fault_axis = 2;
    record.out.fault_value = 99e-6;
    record.out.fault_limit = 95e-6;
  };
  session.Append(Mode::kTripped, 10, {.speed_rad_per_s = 49.0}, trip);
  session.Append(Mode::kOff, 10);
  session.Append(Mode::kTripped, 10, {}, trip);
  const SessionFigures figures = session.Figures(TwoBearingRig());
  ASSERT_TRUE(figures.trip.has_value());
  EXPECT_EQ(figures.trip->fault, Fault::kOrbitExceeded);
  EXPECT_EQ(figures.trip->axis, 2);
  EXPECT_EQ(figures.trip->value, 99e-6);
  EXPECT_EQ(figures.trip->limit, 95e-6);
  EXPECT_EQ(figures.trip->mode_before, Mode::kSpinning);
  EXPECT_EQ(figures.trip->speed_rad_per_s, 49.0);
  EXPECT_NEAR(figures.trip->time_s, 0.001, 1e-12);
  EXPECT_EQ(figures.trips, 2U);
}

TEST(SessionStatistics, CountsWhatWasLost) {
  SyntheticSession session;
  session.Append(Mode::kLevitating, 100);
  session.SkipRecords(7);
  session.Append(Mode::kLevitating, 10, {.radius_m = 100e-6}, [](cycle::CycleRecord& record) {
    record.in.frame_present = false;  // a stale position: not an orbit
    record.in.missed_deadlines = 2;
  });
  session.Append(Mode::kLevitating, 10, {},
                 [](cycle::CycleRecord& record) { record.in.frame.held_currents = 12; });
  const SessionFigures figures = session.Figures(TwoBearingRig());
  EXPECT_EQ(figures.missing_records, 7U);
  EXPECT_EQ(figures.missing_frames, 10U);
  EXPECT_EQ(figures.skipped_periods, 20U);
  EXPECT_EQ(figures.held_currents, 12U);
  EXPECT_EQ(figures.standing.bearings[0].orbit.max_m, 0.0);
}

// The rig counts held currents from its own start: a restart sets the count back.
TEST(SessionStatistics, DoesNotCountARestartOfTheRigAsHeldCurrents) {
  SyntheticSession session;
  const auto held = [](std::uint32_t rig, std::uint32_t count) {
    return [rig, count](cycle::CycleRecord& record) {
      record.in.frame.rig_session = rig;
      record.in.frame.held_currents = count;
    };
  };
  session.Append(Mode::kOff, 5, {}, held(1, 500));  // before this session: not counted
  session.Append(Mode::kOff, 5, {}, held(1, 503));
  session.Append(Mode::kOff, 5, {}, held(2, 1));
  session.Append(Mode::kOff, 5, {}, held(2, 2));
  EXPECT_EQ(session.Figures(TwoBearingRig()).held_currents, 4U);
}

TEST(SessionStatistics, AReadingThatIsNotANumberIsAnInfiniteOrbit) {
  SyntheticSession session;
  session.Append(Mode::kLevitating, 10, {.radius_m = 1e-6}, [](cycle::CycleRecord& record) {
    record.in.frame.position_m[0] = std::numeric_limits<double>::quiet_NaN();
  });
  const SessionFigures figures = session.Figures(TwoBearingRig());
  EXPECT_TRUE(std::isinf(figures.standing.bearings[0].orbit.max_m));
  EXPECT_NEAR(figures.standing.bearings[1].orbit.max_m, 1e-6, kRounding_m);
}

TEST(SessionStatistics, HasNoFiguresOfAnEmptySession) {
  const SessionFigures figures = SyntheticSession{}.Figures(TwoBearingRig());
  EXPECT_EQ(figures.cycles, 0U);
  EXPECT_EQ(figures.standing.cycles, 0U);
  EXPECT_FALSE(figures.trip.has_value());
  EXPECT_TRUE(figures.modes.empty());
}

}  // namespace
}  // namespace levitas::verdict
