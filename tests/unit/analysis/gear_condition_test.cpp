// Condition of gears from made records: what is put on the orbits is found on its wheel by the
// amount that was put there, and what every healthy rig has is not.

#include "analysis/records/gear_condition.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "common/random.hpp"
#include "tests/support/geared_rigs.hpp"

namespace levitas::analysis {
namespace {

using OrbitsAt = std::function<std::complex<double>(std::size_t bearing, double repeats)>;

constexpr double kTau = 2.0 * std::numbers::pi;
constexpr double kRepeatTurns = 3.0;  // of the pinion; two of the gear, sixty teeth
constexpr double kCircle_m = 2e-6;

/// 20 and 30 teeth: lines 3 k are the pinion's, 2 k the gear's, and neither has all of the other's.
plant::PlantConfig TwoToThree() {
  plant::PlantConfig rig = test::GearedRotor4();
  rig.gears[0].driven.teeth = 30;
  return rig;
}

/// Levitated rows at one speed; `orbit` is asked at every row for the repeats turned until there.
session::Recording MadeRecord(double turn_hz, double period_s, double seconds,
                              const OrbitsAt& orbit) {
  session::Recording r;
  r.period_ns = std::llround(1e9 * period_s);
  r.channels = {"p_x", "p_y", "g_x", "g_y"};
  r.position_m.resize(4);
  r.excitation_a.resize(4);
  r.excitation_m.resize(4);
  const auto rows = static_cast<std::size_t>(seconds / period_s);
  r.current_a.assign(4, session::Column(rows, 0.0));
  r.levitated.assign(rows, 1);
  for (std::size_t n = 0; n < rows; ++n) {
    const double turns = 0.37 + turn_hz * period_s * static_cast<double>(n);
    r.cycle.push_back(1000 + n);
    r.speed_rad_per_s.push_back(kTau * turn_hz);
    r.angle_rad.push_back(std::remainder(kTau * turns, kTau));
    for (std::size_t b = 0; b < 2; ++b) {
      const std::complex<double> at = orbit(b, turns / kRepeatTurns);
      r.position_m[2 * b].push_back(at.real());
      r.position_m[2 * b + 1].push_back(at.imag());
    }
  }
  return r;
}

GearCondition WholeRecord(const session::Recording& r, const plant::PlantConfig& rig) {
  return MeasureGears(r, {{0, r.rows()}, r.speed_rad_per_s.front()}, rig);
}

std::complex<double> Turning(double line, double repeats) {
  return std::polar(1.0, kTau * line * repeats);
}

/// A line forward on the pinion's bearing, 0.5 of it backward on the gear's.
GearCondition WithLine(double line, double turn_hz) {
  const auto orbit = [&](std::size_t bearing, double repeats) {
    return kCircle_m * (bearing == 0 ? Turning(line, repeats) : 0.5 * Turning(-line, repeats));
  };
  return WholeRecord(MadeRecord(turn_hz, 1e-4, 2.0, orbit), TwoToThree());
}

// The energies of both bearings add up. The cubic between samples leaves parts in a thousand.
TEST(MadeGearRecord, TellsALineOfAWheelByItsAmplitudeAndItsWheel) {
  const double both_m = kCircle_m * std::sqrt(1.0 + 0.5 * 0.5);
  for (const double turn_hz : {10.1, -10.1}) {  // backwards alike
    const GearCondition pinion = WithLine(3 * 7, turn_hz);
    ASSERT_EQ(pinion.shafts.size(), 2U);
    EXPECT_EQ(pinion.repeats, 6U);  // of 6.7 in two seconds
    EXPECT_NEAR(pinion.shafts[0].Amplitude(), both_m, 2e-3 * both_m);
    EXPECT_LT(pinion.shafts[1].Amplitude(), 1e-3 * both_m);
    EXPECT_EQ(pinion.shafts[0].wheels, "driving wheel of mesh");
    const GearCondition gear = WithLine(2 * 7, turn_hz);
    ASSERT_EQ(gear.shafts.size(), 2U);
    EXPECT_NEAR(gear.shafts[1].Amplitude(), both_m, 2e-3 * both_m);
    EXPECT_LT(gear.shafts[0].Amplitude(), 1e-3 * both_m);
    EXPECT_EQ(gear.shafts[1].wheels, "driven wheel of mesh");
    // x and y of a circle: N sum cos^4/(sum cos^2)^2 = (3/8)/(1/2)^2.
    EXPECT_NEAR(gear.shafts[1].fm4.value, 1.5, 1e-2);
    for (const ShaftCondition& shaft : gear.shafts) EXPECT_TRUE(shaft.shared.empty());
  }
}

// Line 6 k is of both wheels: it names neither where each has lines of its own.
TEST(MadeGearRecord, LeavesALineOfBothWheelsToNeither) {
  const GearCondition both = WithLine(6 * 4, 10.1);
  for (const ShaftCondition& shaft : both.shafts) EXPECT_LT(shaft.Amplitude(), 1e-3 * kCircle_m);
}

// At 20 to 40 teeth every line of the pinion is one of the gear's as well, and it says so.
TEST(MadeGearRecord, SaysThatAPinionOfHalfTheTeethSharesItsLines) {
  const auto orbit = [&](std::size_t, double repeats) {
    return kCircle_m * Turning(1.5 * 9, repeats);  // nine times a turn of the gear of 40 teeth
  };
  const GearCondition gear = WholeRecord(MadeRecord(10.1, 1e-4, 2.0, orbit), test::GearedRotor4());
  EXPECT_THAT(gear.shafts[0].shared, testing::ElementsAre(1U));
  EXPECT_TRUE(gear.shafts[1].shared.empty());
  EXPECT_NEAR(gear.shafts[1].Amplitude(), std::sqrt(2.0) * kCircle_m, 3e-3 * kCircle_m);
  EXPECT_LT(gear.shafts[0].Amplitude(), 1e-3 * kCircle_m);
}

// Teeth in regular engagement, modulated by either shaft, and what shafts do up to three times a
// turn: they count as mesh and as once a turn, and as nothing else.
TEST(MadeGearRecord, TakesMeshAndRotationForNoDamage) {
  const auto orbit = [](std::size_t, double repeats) {
    std::complex<double> sum;
    for (const double line : {60.0, -120.0, 63.0, 54.0, 58.0, 64.0, 6.0, -9.0, 4.0}) {
      sum += Turning(line, repeats);
    }
    return kCircle_m * (sum + 3.0 * Turning(3, repeats) + 2.0 * Turning(-2, repeats));
  };
  const GearCondition of = WholeRecord(MadeRecord(10.1, 1e-4, 2.0, orbit), TwoToThree());
  ASSERT_EQ(of.shafts.size(), 2U);
  for (const ShaftCondition& shaft : of.shafts) EXPECT_LT(shaft.Amplitude(), 5e-3 * kCircle_m);
  EXPECT_NEAR(of.mesh_m, std::sqrt(2.0) * kCircle_m, 1e-2 * kCircle_m);  // 60 and 120
  EXPECT_NEAR(of.shafts[0].once_m, 3.0 * kCircle_m, 1e-2 * kCircle_m);
  EXPECT_NEAR(of.shafts[1].once_m, 2.0 * kCircle_m, 1e-2 * kCircle_m);
}

TEST(MadeGearRecord, OfTooFewTurnsHasNoShafts) {
  const auto round = [](std::size_t, double repeats) { return kCircle_m * Turning(21, repeats); };
  const double repeat_s = RepeatSeconds(TwoToThree(), kTau * 20.3);
  EXPECT_DOUBLE_EQ(repeat_s, kRepeatTurns / 20.3);
  EXPECT_DOUBLE_EQ(RepeatSeconds(TwoToThree(), -kTau * 20.3), repeat_s);
  const auto brief = WholeRecord(MadeRecord(20.3, 2e-4, 4.95 * repeat_s, round), TwoToThree());
  EXPECT_EQ(brief.repeats, 4U);
  EXPECT_TRUE(brief.shafts.empty());
  const auto enough = WholeRecord(MadeRecord(20.3, 2e-4, 5.05 * repeat_s, round), TwoToThree());
  EXPECT_EQ(enough.repeats, 5U);
  EXPECT_EQ(enough.shafts.size(), 2U);
  EXPECT_EQ(WholeRecord(MadeRecord(20.3, 2e-4, 6e-4, round), TwoToThree()).repeats, 0U);
  plant::PlantConfig single = TwoToThree();
  single.gears.clear();
  EXPECT_THROW(static_cast<void>(RepeatSeconds(single, 100.0)), std::invalid_argument);
}

// Stretches end where a cycle is missing, and none of their rows lies beyond it.
TEST(HeldSpeeds, EndAtGapsTestSignalsAndOtherSpeeds) {
  const auto still = [](std::size_t, double) { return std::complex<double>(); };
  const session::Recording whole = MadeRecord(20.3, 1e-3, 3.0, still);
  const std::size_t rows = 3000;
  const std::size_t passes = 300;
  const auto ranges = [](const session::Recording& r, double least_s) {
    std::vector<session::RowRange> found;
    for (const HeldSpeed& held : HeldSpeeds(r, least_s)) found.push_back(held.rows);
    return found;
  };
  using testing::ElementsAre;
  EXPECT_THAT(ranges(whole, 0.5), ElementsAre(session::RowRange{passes, rows}));
  session::Recording gap = whole;
  for (std::size_t n = 1000; n < rows; ++n) gap.cycle[n] += 2;
  const session::RowRange before{passes, 1000};
  EXPECT_THAT(ranges(gap, 0.5), ElementsAre(before, session::RowRange{1000 + passes, rows}));
  EXPECT_THAT(ranges(gap, 1.0), ElementsAre(session::RowRange{1000 + passes, rows}));
  session::Recording lost = whole;
  lost.position_m[3][1000] = std::nan("");
  session::Recording landed = whole;
  landed.levitated[1000] = 0;
  session::Recording tested = whole;
  tested.excitation_m[2].assign(rows, 0.0);
  tested.excitation_m[2][1000] = 1e-6;
  for (const auto& r : {lost, landed, tested}) {
    EXPECT_THAT(ranges(r, 0.5), ElementsAre(before, session::RowRange{1001 + passes, rows}));
  }
  session::Recording faster = whole;
  for (std::size_t n = 1000; n < rows; ++n) faster.speed_rad_per_s[n] *= 1.006;
  EXPECT_THAT(ranges(faster, 0.5), ElementsAre(before, session::RowRange{1000 + passes, rows}));
  EXPECT_NEAR(HeldSpeeds(faster, 0.5)[0].speed_rad_per_s, kTau * 20.3, 1e-9);
  for (std::size_t n = 1000; n < rows; ++n) faster.speed_rad_per_s[n] = 1.004 * kTau * 20.3;
  EXPECT_THAT(ranges(faster, 0.5), ElementsAre(session::RowRange{passes, rows}));
}

/// Energies over their deviations, less what was put there, of records that differ by their noise.
std::vector<double> OverDeviation(double put_m, std::size_t seeds) {
  std::vector<double> out;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    Random random(seed);
    const auto orbit = [&](std::size_t bearing, double repeats) {
      const std::complex<double> noise(random.Normal(), random.Normal());
      const double line = bearing == 0 ? 21.0 : 14.0;  // the pinion's seven, the gear's seven
      return 3e-7 * noise + put_m * Turning(line, repeats);
    };
    const auto of = WholeRecord(MadeRecord(20.3, 4e-4, 1.26, orbit), TwoToThree());
    for (const ShaftCondition& shaft : of.shafts) {
      out.push_back((shaft.energy_m2.value - put_m * put_m) / shaft.energy_m2.deviation);
    }
  }
  return out;
}

// 0 on average, with noise alone and beside a line. Of noise alone the deviation counts max(0, E)
// of every line as if it were one: R = 8 repeats leave sqrt((8/7)/(8/7 + 2/e)) = 0.78 of it.
TEST(MadeGearRecord, OfNoiseIsWithinItsDeviationOverSeeds) {
  for (const auto& [put_m, expected] : {std::pair{0.0, 0.78}, std::pair{3e-7, 1.0}}) {
    const std::vector<double> departures = OverDeviation(put_m, 60);
    ASSERT_EQ(departures.size(), 120U);
    double mean = 0.0;
    double square = 0.0;
    for (const double z : departures) {
      mean += z / 120.0;
      square += z * z / 120.0;
    }
    EXPECT_LT(std::abs(mean), 4.0 * expected / std::sqrt(120.0)) << put_m;
    // The root of a mean of 120 squares scatters by 1/sqrt(240); four of that.
    EXPECT_NEAR(std::sqrt(square), expected, 4.0 * expected / std::sqrt(240.0)) << put_m;
  }
}

}  // namespace
}  // namespace levitas::analysis
