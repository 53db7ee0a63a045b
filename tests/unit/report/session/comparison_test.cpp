// Records made by formula, set side by side: speeds, amplitudes and orbits in closed form.

#include "report/session/comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/problem.hpp"
#include "tests/support/paths.hpp"

namespace levitas::report {
namespace {

constexpr double kHeld = 200.0;  // rad/s

/// A second at each of these speeds, whirling forward in a circle about the centre.
RecordToCompare Whirling(const std::string& label, double radius_m,
                         const std::vector<double>& speeds_rad_per_s) {
  RecordToCompare made;
  made.label = label;
  made.path = label + ".lcm";
  made.rig =
      configuration::LoadRig(levitas::test::SourceFolder() + "/config/rigs/flexible_rotor.yaml");
  session::Recording& r = made.recording;
  r.period_ns = made.rig.numbers.period_ns;
  r.channels = made.rig.numbers.channels;
  r.sensor_range_m.assign(4, 400e-6);
  r.current_limit_a = 1.0;
  r.position_m.resize(4);
  r.current_a.resize(4);
  r.excitation_a.resize(4);
  r.excitation_m.resize(4);
  double angle_rad = 0.0;
  std::uint64_t cycle = 0;
  const auto rows = static_cast<int>(std::lround(1.0 / r.period_s()));
  for (const double speed : speeds_rad_per_s) {
    for (int row = 0; row < rows; ++row) {
      r.cycle.push_back(cycle++);
      r.levitated.push_back(1);
      r.amplifiers_enabled.push_back(1);
      r.speed_rad_per_s.push_back(speed);
      r.angle_rad.push_back(std::fmod(angle_rad, 2.0 * std::numbers::pi));
      r.bias_current_a.push_back(1.0);
      for (std::size_t axis = 0; axis < 4; ++axis) {
        r.position_m[axis].push_back(radius_m *
                                     (axis % 2 == 0 ? std::cos(angle_rad) : std::sin(angle_rad)));
        r.current_a[axis].push_back(0.0);
      }
      angle_rad += speed * r.period_s();
    }
  }
  return made;
}

TEST(Compare, FindsTheAmplitudeOfEachRecordAtTheSpeedThatBothHold) {
  const Comparison found =
      Compare({Whirling("a", 10e-6, {kHeld}), Whirling("b", 25e-6, {kHeld})}, {});
  ASSERT_EQ(found.speeds_rad_per_s.size(), 1U);
  EXPECT_NEAR(found.speeds_rad_per_s[0], kHeld, 1e-9);
  ASSERT_EQ(found.records.size(), 2U);
  for (const auto& [record, radius_m] : {std::pair{0, 10e-6}, {1, 25e-6}}) {
    const auto& at = found.records[static_cast<std::size_t>(record)].speeds.at(0);
    ASSERT_TRUE(at.has_value());
    EXPECT_TRUE(at->found.held);
    for (const auto& axis : at->found.position_m) {
      EXPECT_NEAR(axis.amplitude.at(0), radius_m, 1e-6 * radius_m);
    }
  }
}

TEST(Compare, LeavesASpeedEmptyThatARecordNeitherHoldsNorPasses) {
  const Comparison found =
      Compare({Whirling("a", 10e-6, {kHeld, 300.0}), Whirling("b", 10e-6, {kHeld})}, {});
  ASSERT_EQ(found.speeds_rad_per_s.size(), 2U);
  EXPECT_TRUE(found.records[0].speeds[1].has_value());
  EXPECT_FALSE(found.records[1].speeds[1].has_value());
}

// 0.5 % apart is one speed of two drives, 3 % are two speeds.
TEST(Compare, TakesSpeedsThatDifferByLessThanAPercentForOne) {
  const auto speeds = [](double other) {
    return Compare({Whirling("a", 10e-6, {kHeld}), Whirling("b", 10e-6, {other})}, {})
        .speeds_rad_per_s.size();
  };
  EXPECT_EQ(speeds(1.005 * kHeld), 1U);
  EXPECT_EQ(speeds(1.03 * kHeld), 2U);
}

TEST(Compare, ShowsTheLastTwoTurnsAsOrbitOfEachBearingWithinSixHundredPoints) {
  // Two turns at 10 000 rows a second: 419 rows at 300 rad/s, 628 at 200 rad/s, of which every
  // second is taken.
  for (const auto& [speed, step] : {std::pair{300.0, 1.0}, {200.0, 2.0}}) {
    const Comparison found = Compare({Whirling("a", 10e-6, {speed})}, {});
    const AtSpeed& at = *found.records[0].speeds[0];
    ASSERT_EQ(at.orbits.size(), 2U);
    for (const Orbit& orbit : at.orbits) {
      ASSERT_EQ(orbit.x_m.size(), orbit.y_m.size());
      EXPECT_NEAR(static_cast<double>(orbit.x_m.size()),
                  4.0 * std::numbers::pi / speed * 1e4 / step, 2.0);
      for (std::size_t i = 0; i < orbit.x_m.size(); ++i) {
        EXPECT_NEAR(std::hypot(orbit.x_m[i], orbit.y_m[i]), 10e-6, 1e-12);
      }
    }
  }
}

TEST(Compare, TakesTheSpeedsThatAreAskedForInTheirOrder) {
  ComparisonRequest request;
  request.speeds_rad_per_s = {300.0, kHeld};
  const Comparison found = Compare({Whirling("a", 10e-6, {kHeld, 300.0})}, request);
  EXPECT_EQ(found.speeds_rad_per_s, request.speeds_rad_per_s);
  EXPECT_NEAR(found.records[0].speeds[0]->found.speed_rad_per_s, 300.0, 1e-6);
}

TEST(Compare, GoesOverAllSpeedsOnlyWhenAsked) {
  ComparisonRequest request;
  EXPECT_TRUE(Compare({Whirling("a", 10e-6, {kHeld})}, request).records[0].over_speed.empty());
  request.over_speed = true;
  EXPECT_FALSE(Compare({Whirling("a", 10e-6, {kHeld})}, request).records[0].over_speed.empty());
}

TEST(Compare, RefusesARecordWithOtherChannelsAndNamesBoth) {
  RecordToCompare other = Whirling("b", 10e-6, {kHeld});
  other.rig.numbers.channels[3] = "thrust";
  try {
    (void)Compare({Whirling("a", 10e-6, {kHeld}), other}, {});
    FAIL() << "taken";
  } catch (const BadInput& problem) {
    const std::string text = problem.what();
    for (const char* part : {"a.lcm", "b.lcm", "thrust"}) {
      EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
    }
  }
}

TEST(Compare, RefusesRecordsThatHoldNoSpeedAndSaysWhatHelps) {
  RecordToCompare lying = Whirling("a", 10e-6, {kHeld});
  std::fill(lying.recording.levitated.begin(), lying.recording.levitated.end(), std::uint8_t{0});
  try {
    (void)Compare({lying}, {});
    FAIL() << "taken";
  } catch (const BadInput& problem) {
    EXPECT_NE(std::string(problem.what()).find("--speeds"), std::string::npos) << problem.what();
  }
}

}  // namespace
}  // namespace levitas::report
