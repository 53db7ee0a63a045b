// What a table of a positioning platform says beside the curve: hysteresis, repeatability, the
// straight range; and that the written curve takes a probe's error out of its readings.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <string>

#include "configuration/rig_file.hpp"
#include "identification/probe/probe_characteristic.hpp"
#include "plant_sim/sensor/characteristic.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::identification {
namespace {

constexpr double kProbeStepM = 5e-6;
constexpr int kProbeSteps = 12;  ///< on either side of the centre

/// From -60 um to +60 um and back, each place read twice on either way: `reading` of displacement,
/// way and number of the reading.
template <typename Reading>
PlatformTable ThereAndBack(const Reading& reading) {
  PlatformTable table;
  for (const int way : {1, -1}) {
    // Nothing tells the way of a reading at the turn itself: it belongs to the way there.
    for (int step = way > 0 ? -kProbeSteps : 1 - kProbeSteps; step <= kProbeSteps; ++step) {
      for (const int again : {0, 1}) {
        table.displacement_m.push_back(way * step * kProbeStepM);
        table.reading.push_back(reading(way * step * kProbeStepM, way, again));
      }
    }
  }
  return table;
}

// Shifting one branch by h moves the middle of both by h/2 and nothing else.
TEST(ProbeCalibration, FindsHysteresisByWhichTheBranchBackIsShifted) {
  constexpr double kShiftM = 0.8e-6;
  constexpr double kSlope = 1.03;
  const auto found = FitProbe(
      ThereAndBack([](double x, int way, int) { return kSlope * x - (way < 0 ? kShiftM : 0.0); }),
      "ux.csv");
  ASSERT_TRUE(found.hysteresis && found.largest_hysteresis);
  EXPECT_NEAR(found.hysteresis->value, kShiftM, 1e-12);
  EXPECT_NEAR(*found.largest_hysteresis, kShiftM, 1e-12);
  EXPECT_NEAR(found.offset.value, -0.5 * kShiftM, 1e-12);
  EXPECT_NEAR(found.gain.value, kSlope, 1e-9);
  for (const sensor::ProbePoint& point : found.points) {
    EXPECT_NEAR(point.reading_m, kSlope * point.displacement_m, 1e-12);
  }
}

// A loop that is wide in the middle and closed at its ends: the mean over all is not its width.
TEST(ProbeCalibration, LargestHysteresisIsThatOfThePlaceWhereTheLoopIsWidest) {
  constexpr double kWidthM = 1e-6;
  constexpr double kEndM = kProbeSteps * kProbeStepM;
  const auto found = FitProbe(ThereAndBack([](double x, int way, int) {
                                return x + 0.5 * way * kWidthM * (1.0 - std::abs(x) / kEndM);
                              }),
                              "ux.csv");
  ASSERT_TRUE(found.hysteresis && found.largest_hysteresis);
  EXPECT_NEAR(*found.largest_hysteresis, kWidthM, 1e-3 * kWidthM);
  EXPECT_GT(found.hysteresis->value, 0.3 * kWidthM);
  EXPECT_LT(found.hysteresis->value, 0.7 * kWidthM);
}

// Two readings that lie s above and below their mean deviate by s sqrt(2), whatever the curve and
// the hysteresis between the ways.
TEST(ProbeCalibration, RepeatabilityIsThatOfReadingsOfOnePlaceAndOneWay) {
  constexpr double kHalfM = 0.1e-6;
  const auto found =
      FitProbe(ThereAndBack([](double x, int way, int again) {
                 return x + 1e3 * x * x + 3e-6 * way + (again == 0 ? kHalfM : -kHalfM);
               }),
               "ux.csv");
  ASSERT_TRUE(found.repeatability);
  EXPECT_NEAR(*found.repeatability, kHalfM * std::sqrt(2.0), 1e-12);
}

TEST(ProbeCalibration, WithoutRepeatsClaimsNoRepeatability) {
  PlatformTable once;
  for (int step = -kProbeSteps; step <= kProbeSteps; ++step) {
    once.displacement_m.push_back(step * kProbeStepM);
    once.reading.push_back(step * kProbeStepM);
  }
  EXPECT_FALSE(FitProbe(once, "ux.csv").repeatability.has_value());
}

// |a3| x^3 = e at x = cbrt(e/|a3|), on either side; the table's ends bound it.
TEST(ProbeCalibration, IsStraightUpToTheErrorThatIsAskedFor) {
  constexpr double kA3 = -2e7;
  const PlatformTable table =
      ThereAndBack([](double x, int, int) { return x * (1.0 + kA3 * x * x); });
  for (const double error_m : {1e-7, 5e-7, 2e-6}) {
    const auto found = FitProbe(table, "ux.csv", {.straight_error_m = error_m});
    const double expected_m = std::cbrt(error_m / -kA3);
    EXPECT_NEAR(found.straight_high_m, expected_m, 0.05e-6) << error_m;
    EXPECT_NEAR(found.straight_low_m, -expected_m, 0.05e-6) << error_m;
  }
  const auto loose = FitProbe(table, "ux.csv", {.straight_error_m = 1e-5});
  EXPECT_DOUBLE_EQ(loose.straight_high_m, loose.high_m);
  EXPECT_DOUBLE_EQ(loose.straight_low_m, loose.low_m);
}

/// The displacement at which the curve reads `reading`: halving, since it rises all the way.
double Corrected(const sensor::Characteristic& curve, double reading) {
  double low = -1e-4;
  double high = 1e-4;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (curve(middle) < reading ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// The way of a user: the table becomes the curve of a rig file, that file is read, and its curve
// inverted takes the probe's error out, to what the rows of a place leave of their repeatability.
TEST(ProbeCalibration, CurveOfTheWrittenRigFileCorrectsReadingsWithinTheStatedError) {
  std::mt19937_64 random(71);
  std::normal_distribution<double> noise(0.0, 0.1e-6);
  const auto truth = [](double x) { return 2e-6 + x * (1.0 + x * (1000.0 - 2e7 * x)); };
  const auto found = FitProbe(
      ThereAndBack([&](double x, int, int) { return truth(x) + noise(random); }), "ux.csv");
  configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("one_axis", "rigs"));
  rig.plant.bearings[0].sensor.characteristic = found.points;
  const test::ScratchFolder rig_folder;
  std::ofstream(rig_folder / "measured.yaml") << configuration::WriteRig(rig);
  const configuration::RigFile read = configuration::LoadRig(rig_folder / "measured.yaml");
  const sensor::Characteristic curve(read.plant.bearings[0].sensor.characteristic);
  ASSERT_TRUE(found.repeatability);
  constexpr double kRowsOfAPlace = 4.0;
  // Four deviations of a place's mean, over a slope that is 0.8 at least, and of the offset.
  const double stated_m =
      4.0 * (*found.repeatability / std::sqrt(kRowsOfAPlace) + found.offset.deviation) / 0.8;
  double uncorrected_m = 0.0;
  for (double x = -50e-6; x < 51e-6; x += 3.3e-6) {
    const double reading = truth(x) - found.offset.value;
    EXPECT_NEAR(Corrected(curve, reading), x, stated_m) << x;
    uncorrected_m = std::max(uncorrected_m, std::abs(reading - x));
  }
  EXPECT_GT(uncorrected_m, 5.0 * stated_m);  // there was something to correct
}

}  // namespace
}  // namespace levitas::identification
