// A probe's characteristic from a table of a positioning platform: what is put in comes out within
// the stated deviations, and a table that is none is refused with its reason.

#include "identification/probe/probe_characteristic.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <string>

#include "common/problem.hpp"
#include "plant_sim/sensor/characteristic.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::identification {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A probe that is known.
struct Truth {
  double offset{2e-6}, gain{1.03}, a2{1000.0}, a3{-2e7};
  double hysteresis{0.4e-6}, noise{0.1e-6};
};

/// There and back over +-60 um in steps of 5 um, `rounds` times, each place read twice.
PlatformTable Measured(const Truth& truth, int rounds, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  PlatformTable table;
  const auto read = [&](int step, double way) {
    const double x = 5e-6 * step;
    for (int again = 0; again < 2; ++again) {
      table.displacement_m.push_back(x);
      table.reading.push_back(truth.offset +
                              truth.gain * x * (1.0 + x * (truth.a2 + x * truth.a3)) +
                              0.5 * way * truth.hysteresis + truth.noise * normal(random));
    }
  };
  for (int round = 0; round < rounds; ++round) {
    for (int step = -12; step <= 12; ++step) read(step, round == 0 || step > -12 ? 1.0 : -1.0);
    for (int step = 11; step >= -12; --step) read(step, -1.0);
  }
  return table;
}

TEST(ProbeCharacteristic, HoldsTheTruthWithinItsDeviations) {
  const Truth truth;
  int within = 0;
  int all = 0;
  constexpr int kSeeds = 60;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto found = FitProbe(Measured(truth, 2, seed), "probe.csv");
    const auto count = [&](const Estimate& estimate, double value) {
      within += std::abs(estimate.value - value) < 1.96 * estimate.deviation ? 1 : 0;
      ++all;
    };
    count(found.offset, truth.offset);
    count(found.gain, truth.gain);
    count(found.a2, truth.a2);
    count(found.a3, truth.a3);
    ASSERT_TRUE(found.hysteresis.has_value());
    count(*found.hysteresis, truth.hysteresis);
    ASSERT_TRUE(found.repeatability.has_value());
    EXPECT_NEAR(*found.repeatability, truth.noise, 0.2 * truth.noise);  // some 150 rows
    EXPECT_TRUE(found.cubic_suffices.value()) << seed;
  }
  // 95 % of 300; three deviations of that count are 11.
  EXPECT_EQ(all, 5 * kSeeds);
  EXPECT_NEAR(within, 0.95 * all, 12.0);
}

TEST(ProbeCharacteristic, OfOneWayDoesNotClaimHysteresis) {
  Truth truth;
  PlatformTable table = Measured(truth, 1, 3);
  table.displacement_m.resize(50);
  table.reading.resize(50);
  const auto found = FitProbe(table, "probe.csv");
  EXPECT_FALSE(found.hysteresis.has_value());
  EXPECT_TRUE(found.repeatability.has_value());
}

// |a2| x^2 reaches 1 um at 31.6 um on either side.
TEST(ProbeCharacteristic, IsStraightAsFarAsItsCurvatureAllows) {
  const auto found =
      FitProbe(Measured({.a3 = 0.0, .hysteresis = 0.0, .noise = 0.0}, 1, 1), "probe.csv");
  EXPECT_NEAR(found.straight_high_m, 31.6e-6, 0.1e-6);
  EXPECT_NEAR(found.straight_low_m, -31.6e-6, 0.1e-6);
  EXPECT_NEAR(found.largest_curvature_m, 3.6e-6, 1e-9);
  EXPECT_NEAR(found.a2.value, 1000.0, 1e-3);
}

// The points are what a rig file takes: they pass its check, and reading the simulated probe gives
// the true curve back.
TEST(ProbeCharacteristic, GivesPointsThatTheSimulatedProbeReadsBack) {
  const Truth truth;
  const auto found = FitProbe(Measured(truth, 4, 5), "probe.csv");
  ASSERT_NO_THROW(sensor::CheckCharacteristic("test", found.points));
  const sensor::Characteristic probe(found.points);
  for (double x = -55e-6; x < 56e-6; x += 3.7e-6) {
    const double reading = truth.gain * x * (1.0 + x * (truth.a2 + x * truth.a3));
    EXPECT_NEAR(probe(x), reading, 0.15e-6) << x;  // noise over sqrt(16), and the curve between
  }
}

TEST(ProbeCharacteristic, OfVoltsIsScaledByItsGain) {
  const Truth truth;
  PlatformTable volts = Measured(truth, 2, 9);
  for (double& reading : volts.reading) reading *= 25e3;
  volts.volts = true;
  const auto found = FitProbe(volts, "probe.csv");
  EXPECT_NEAR(found.gain.value, 25e3 * truth.gain, 5.0 * found.gain.deviation);
  EXPECT_NEAR(found.a2.value, truth.a2, 5.0 * found.a2.deviation);
  const sensor::Characteristic probe(found.points);
  EXPECT_NEAR(probe.SlopeAtCentre(), 1.0, 0.02);
}

// A curve that is no cubic is said to be none.
TEST(ProbeCharacteristic, SaysWhenACubicDoesNotSuffice) {
  PlatformTable table = Measured({}, 2, 4);
  for (std::size_t k = 0; k < table.rows(); ++k) {
    table.reading[k] += 1e-6 * std::sin(table.displacement_m[k] / 8e-6);
  }
  EXPECT_FALSE(FitProbe(table, "probe.csv").cubic_suffices.value());
}

/// Right up to a step of 5 um at 20 um, there and back, as often as asked.
PlatformTable Stepped(int rounds, double unit) {
  PlatformTable table;
  const auto read = [&](int step) {
    const double x = 2e-6 * step;
    table.displacement_m.push_back(x);
    table.reading.push_back(unit * (x + (x > 20e-6 ? 5e-6 : 0.0) + 1e-6));
  };
  for (int round = 0; round < rounds; ++round) {
    for (int step = -25; step <= 25; ++step) read(step);
    for (int step = 24; step > -25; --step) read(step);
  }
  return table;
}

// The cubic's own offset and slope about the centre are wrong by what it misses elsewhere.
TEST(ProbeCharacteristic, TakesThePointsFromThePlacesWhereACubicDoesNotSuffice) {
  for (const double unit : {1.0, 25e3}) {
    PlatformTable table = Stepped(2, unit);
    table.volts = unit != 1.0;
    const auto found = FitProbe(table, "probe.csv");
    ASSERT_TRUE(found.cubic_suffices);
    EXPECT_FALSE(*found.cubic_suffices);
    EXPECT_EQ(found.places, 51U);  // 50 parts and as many steps: rounding merges none
    EXPECT_GT(std::abs(found.offset.value / unit - 1e-6), 0.3e-6);
    EXPECT_NEAR(found.points_offset / unit, 1e-6, 1e-12);
    const sensor::Characteristic probe(found.points);
    for (double x = -50e-6; x < 51e-6; x += 2e-6) {
      // The ends are met on one way only: half of the hysteresis that the cubic finds in the step.
      EXPECT_NEAR(probe(x), x + (x > 21e-6 ? 5e-6 : 0.0), 0.05e-6) << x;
    }
  }
}

TEST(ProbeCharacteristic, JudgesNoCubicWhereNothingWasRepeated) {
  PlatformTable table = Stepped(1, 1.0);
  table.displacement_m.resize(51);  // one way, every place once
  table.reading.resize(51);
  const auto found = FitProbe(table, "probe.csv");
  EXPECT_FALSE(found.repeatability);
  EXPECT_FALSE(found.cubic_suffices);
  EXPECT_GT(found.largest_misfit, 0.5e-6);
}

// Five rows in each part of the way, none at the displacement of another, and no noise: what they
// differ by is the curve.
TEST(ProbeCharacteristic, DoesNotTakeTheCurveForNoise) {
  PlatformTable table;
  for (int step = -100; step <= 100; ++step) {
    const double x = 1e-6 * step;
    table.displacement_m.push_back(x);
    table.reading.push_back(60e-6 * std::tanh(x / 60e-6));
  }
  const auto found = FitProbe(table, "probe.csv", {.most_places = 40});
  EXPECT_GT(found.residual, 0.2e-6);
  ASSERT_TRUE(found.repeatability);
  EXPECT_LT(*found.repeatability, 0.01 * found.residual);
  EXPECT_FALSE(found.cubic_suffices.value());
}

class PlatformFile : public testing::Test {
 protected:
  std::string Write(const std::string& text) {
    std::ofstream(folder_ / "probe.csv") << text;
    return folder_ / "probe.csv";
  }
  /// What the table is refused with; empty: it is taken.
  std::string Refusal(const std::string& text) {
    const std::string path = Write(text);
    try {
      (void)FitProbe(ReadPlatformTable(path), path);
      return {};
    } catch (const BadInput& refused) {
      return refused.what();
    }
  }
  static std::string Rows(const std::string& header, double factor = 1.0, int bad_row = -99,
                          const std::string& cell = {}) {
    std::string text = header + "\n";
    for (int n = -5; n <= 5; ++n) {
      text += std::to_string(10 * n) + "," +
              (n == bad_row ? cell : std::to_string(factor * (10 * n + 0.02 * n * n))) + "\n";
    }
    return text;
  }

  test::ScratchFolder folder_;
};

TEST_F(PlatformFile, IsReadWithItsUnits) {
  const auto table =
      ReadPlatformTable(Write("# platform 7\n" + Rows("displacement_um,reading_mv")));
  EXPECT_TRUE(table.volts);
  ASSERT_EQ(table.rows(), 11U);
  EXPECT_DOUBLE_EQ(table.displacement_m.front(), -50e-6);
  EXPECT_NEAR(table.reading.back(), 50.5e-3, 1e-12);
  EXPECT_EQ(Refusal(Rows("displacement,reading\num,um")), "");
  EXPECT_EQ(Refusal(Rows("displacement_um,reading_um")), "");
}

TEST_F(PlatformFile, ThatIsNoTableIsRefusedWithItsReason) {
  EXPECT_THAT(Refusal("displacement_um\n1\n2\n3\n"), HasSubstr("no column 'reading_<"));
  EXPECT_THAT(Refusal(Rows("displacement,reading_um")),
              AllOf(HasSubstr("line 1"), HasSubstr("'displacement' has no unit")));
  EXPECT_THAT(Refusal(Rows("displacement_inch,reading_um")), HasSubstr("the unit 'inch'"));
  EXPECT_THAT(Refusal(Rows("displacement_um,reading_um", 1.0, 2, "nan")),
              AllOf(HasSubstr("line 9"), HasSubstr("'nan' is no finite number")));
  EXPECT_THAT(Refusal(Rows("displacement_um,reading_um", -1.0)), HasSubstr("does not rise from"));
  EXPECT_THAT(Refusal(Rows("displacement_um,reading_um", 1.0, 4, "3.0")),
              HasSubstr("does not rise from displacement 30 um to 40 um"));
  EXPECT_THAT(Refusal("displacement_um,reading_um\n1,1\n2,2\n"), HasSubstr("2 rows"));
  std::string one_side = "displacement_um,reading_um\n";
  for (int n = 1; n < 12; ++n) one_side += std::to_string(n) + "," + std::to_string(n) + "\n";
  EXPECT_THAT(Refusal(one_side), HasSubstr("the centre, 0"));
}

}  // namespace
}  // namespace levitas::identification
