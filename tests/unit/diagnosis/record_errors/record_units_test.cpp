// Units of positions and rotation, and the distance of rows: named where they are wrong, with the
// factor, and not where a rig or its clock is merely a little off.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "diagnosis/record_errors/position_unit.hpp"
#include "diagnosis/record_errors/rate.hpp"
#include "diagnosis/record_errors/rotation_unit.hpp"
#include "tests/unit/diagnosis/recorded_loop.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kPi = std::numbers::pi;
const LoopPlan kTurning{.rows = 10'000, .speed_rad_per_s = 300.0, .orbit_m = 10e-6};

Record Scaled(double factor, std::size_t from, std::size_t to) {
  Record record = RecordedLoop();
  for (auto& row : record.rows) {
    for (std::size_t a = from; a < to; ++a) row.sample.position_m[a] *= factor;
  }
  return record;
}

RecordErrors PositionUnits(const Record& record) {
  RecordErrors out;
  FindPositionUnits(RotorView(), record, out);
  return out;
}

TEST(PositionUnit, AThousandToEitherSideIsNamedWithItsColumnsAndMended) {
  for (const double factor : {1e3, 1e-3, 1e6}) {
    const RecordErrors found = PositionUnits(Scaled(factor, 0, 2));
    ASSERT_EQ(found.errors.size(), 1U);
    EXPECT_EQ(found.errors[0].columns,
              (std::vector<std::string>{"position_de_x", "position_de_y"}));
    EXPECT_NEAR(found.errors[0].size * factor, 1.0, 1e-9);
    EXPECT_NEAR(found.uses.position[0].factor * factor, 1.0, 1e-9);
    EXPECT_DOUBLE_EQ(found.uses.position[2].factor, 1.0);
  }
}

TEST(PositionUnit, ProbesThatAreTwentyTimesAsQuietOrAsLoudAreProbes) {
  EXPECT_TRUE(PositionUnits(Scaled(1.0, 0, 4)).errors.empty());
  EXPECT_TRUE(PositionUnits(Scaled(20.0, 0, 4)).errors.empty());
  EXPECT_TRUE(PositionUnits(Scaled(0.05, 0, 4)).errors.empty());
}

TEST(PositionUnit, MotionWithinTheClearanceIsNoNoise) {
  // 60 times the noise, every second row to the other side: within 190 um, and beyond them.
  for (const double swing_m : {60e-6, 400e-6}) {
    Record record = RecordedLoop();
    double side = 0.125 * swing_m;
    for (auto& row : record.rows) row.sample.position_m[0] += 8.0 * (side = -side);
    EXPECT_EQ(PositionUnits(record).errors.size(), swing_m > 190e-6 ? 1U : 0U) << swing_m;
  }
}

RecordErrors RotationUnits(const Record& record) {
  RecordErrors out;
  FindRotationUnit(RotorView(), AllColumns(record), out);
  return out;
}

TEST(RotationUnit, ASpeedInRpmOrHzBesideARightAngleIsNamed) {
  for (const double factor : {30.0 / kPi, 0.5 / kPi}) {
    Record record = RecordedLoop(kTurning);
    for (auto& row : record.rows) row.sample.speed_rad_per_s *= factor;
    const RecordErrors found = RotationUnits(record);
    ASSERT_EQ(found.errors.size(), 1U) << factor;
    EXPECT_EQ(found.errors[0].columns, std::vector<std::string>{"speed"});
    EXPECT_NEAR(found.speed_factor * factor, 1.0, 1e-6);
  }
}

// 0 to 360, taken for radians and wrapped: at 3000 rad/s it turns by 2.7 turns from row to row.
TEST(RotationUnit, AnAngleInDegreesThatTurnsByTurnsFromRowToRowIsNamed) {
  for (const double speed_rad_per_s : {300.0, 785.4, 3000.0}) {
    Record record =
        RecordedLoop({.rows = 10'000, .speed_rad_per_s = speed_rad_per_s, .orbit_m = 3e-6});
    for (auto& row : record.rows) {
      const double degrees = std::fmod(row.sample.angle_rad, 2.0 * kPi) * 180.0 / kPi;
      row.sample.angle_rad = std::fmod(degrees, 2.0 * kPi);
    }
    const RecordErrors found = RotationUnits(record);
    ASSERT_EQ(found.errors.size(), 1U) << speed_rad_per_s;
    EXPECT_EQ(found.errors[0].columns, std::vector<std::string>{"rotor_angle"});
    EXPECT_NEAR(found.angle_factor, kPi / 180.0, 1e-9) << speed_rad_per_s;
  }
}

TEST(RotationUnit, AnAngleInDegreesFromWhichTheSpeedWasMadeIsSeenByTheOrbit) {
  Record record = RecordedLoop(kTurning);
  for (auto& row : record.rows) {
    row.sample.speed_rad_per_s *= kPi / 180.0;
    row.sample.angle_rad *= kPi / 180.0;
  }
  const RecordErrors found = RotationUnits(record);
  ASSERT_EQ(found.errors.size(), 1U);
  EXPECT_EQ(found.errors[0].columns, std::vector<std::string>{"rotor_angle"});
  EXPECT_NEAR(found.errors[0].size, 180.0 / kPi, 1e-6);
}

TEST(RotationUnit, ARightRotationAStandingRotorAndOneWithoutOrbitAreNot) {
  EXPECT_TRUE(RotationUnits(RecordedLoop(kTurning)).errors.empty());
  EXPECT_TRUE(RotationUnits(RecordedLoop()).errors.empty());
  EXPECT_TRUE(RotationUnits(RecordedLoop({.rows = 10'000, .speed_rad_per_s = 5.0})).errors.empty());
}

std::vector<double> Times(double factor, double drift, std::size_t rows = 4000) {
  std::vector<double> times_s{0.0};
  for (std::size_t n = 1; n < rows; ++n) {
    const double share = static_cast<double>(n) / static_cast<double>(rows);
    times_s.push_back(times_s.back() + RotorView().period_s * (factor + drift * share));
  }
  return times_s;
}

RecordErrors Clock(const std::vector<double>& times_s) {
  RecordErrors out;
  FindClock(RotorView(), times_s, out);
  return out;
}

TEST(Clock, ThatIsFastSlowOrDriftingIsNamedAndMended) {
  for (const double factor : {0.98, 1.2}) {
    const RecordErrors found = Clock(Times(factor, 0.0));
    ASSERT_EQ(found.errors.size(), 1U);
    EXPECT_EQ(found.errors[0].kind, RecordErrorKind::kRate);
    EXPECT_NEAR(found.time_factor * factor, 1.0, 1e-9);
    EXPECT_FALSE(found.drifts);
  }
  EXPECT_TRUE(Clock(Times(1.0, 0.01)).drifts);
}

TEST(Clock, OfACrystalDropOutsAndFewTimesAreNot) {
  EXPECT_TRUE(Clock(Times(1.0001, 0.0)).errors.empty());
  EXPECT_TRUE(Clock(Times(1.1, 0.0, 100)).errors.empty());
  std::vector<double> lost = Times(1.0, 0.0);
  lost.erase(lost.begin() + 1000, lost.begin() + 1100);
  EXPECT_TRUE(Clock(lost).errors.empty());
  EXPECT_TRUE(Clock({}).errors.empty());
}

/// One of every `every` rows.
Record Thinned(std::size_t every) {
  const Record whole = RecordedLoop(kTurning);
  Record record = whole;
  record.rows.clear();
  for (std::size_t n = 0; n < whole.rows.size(); n += every) {
    record.rows.push_back(whole.rows[n]);
    record.rows.back().cycle = n / every;
  }
  return record;
}

RecordErrors Rotation(const Record& record) {
  RecordErrors out;
  static_cast<void>(FindRateOfRotation(RotorView(), AllColumns(record), out));
  return out;
}

TEST(RateOfRotation, SaysHowManyRowsAreLeftOut) {
  for (const std::size_t every : {2U, 3U}) {
    const RecordErrors found = Rotation(Thinned(every));
    ASSERT_EQ(found.errors.size(), 1U);
    EXPECT_NEAR(found.errors[0].size, static_cast<double>(every), 1e-6);
  }
}

TEST(RateOfRotation, IsRightForWholeRecordsAndUnknownOfStandingOnes) {
  EXPECT_TRUE(Rotation(Thinned(1)).errors.empty());
  EXPECT_TRUE(Rotation(RecordedLoop()).errors.empty());
}

TEST(RateOfRotation, ASpeedThatIsAFewPerCentOffIsAFaultOfNoRecord) {
  Record record = RecordedLoop(kTurning);
  for (auto& row : record.rows) row.sample.speed_rad_per_s *= 0.97;
  EXPECT_TRUE(Rotation(record).errors.empty());
}

}  // namespace
}  // namespace levitas::diagnosis
