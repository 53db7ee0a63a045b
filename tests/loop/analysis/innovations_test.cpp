// Innovations on records of the nonlinear plant in closed loop: white and at the noise when the
// model is the plant, and larger at the right place when one thing differs.

#include "analysis/records/innovations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "common/random.hpp"
#include "common/rotational_speed.hpp"
#include "controller/law/axis_law.hpp"
#include "plant_sim/plant/plant.hpp"
#include "tests/support/test_rigs.hpp"
#include "tests/unit/analysis/laws.hpp"

namespace levitas::analysis {
namespace {

constexpr std::size_t kRows = 20'000;
constexpr double kExcitationA = 0.05;  // [A] random binary, so that the magnets work

/// Two seconds of closed loop at a constant speed, after half a second to settle.
std::vector<RecordedRow> Record(const plant::PlantConfig& truth, double speed_rad_per_s,
                                std::uint64_t seed = 20261121) {
  const law::LawCoefficients law(test::FlexibleRotorLaw());
  law::LawState state(law);
  plant::Plant plant(truth, seed);
  plant.SetSpeed(speed_rad_per_s, 0.0);
  Random random(seed + 1);
  std::vector<RecordedRow> rows;
  constexpr std::size_t kSettle = 5'000;
  for (std::size_t n = 0; n < kSettle + kRows; ++n) {
    const SensorFrame frame = plant.Sample();
    AxisArray error_m{};
    RecordedRow row;
    for (std::size_t i = 0; i < 4; ++i) {
      error_m[i] = -frame.position_m[i];
      row.excitation_a[i] = random.Uniform() < 0.5 ? kExcitationA : -kExcitationA;
    }
    plant::PlantCommand command;
    command.bias_current_a = 1.0;
    command.control_current_a =
        law::Step(law, state, error_m, row.excitation_a, 1.0).control_current_a;
    command.drive_enabled = true;
    command.speed_set_point_rad_per_s = speed_rad_per_s;
    row.cycle = frame.cycle;
    row.levitated = true;
    row.sample = {frame.position_m, command, frame.speed_rad_per_s, frame.angle_rad};
    if (n >= kSettle) rows.push_back(row);
    plant.Advance(command);
  }
  return rows;
}

struct Outcome {
  InnovationRun run;
  InnovationReport report;
};

/// What the model of the unchanged rig makes of a record.
Outcome Simulate(const std::vector<RecordedRow>& rows, double speed_rad_per_s) {
  const plant::PlantConfig model = test::FlexibleRotor();
  ObserverTuning tuning;
  tuning.speed_rad_per_s = speed_rad_per_s;
  const auto gain = std::make_shared<const ObserverGain>(DesignObserver(model, tuning));
  Outcome outcome;
  outcome.run = RunObserver(model, gain, rows, gain->settling_s);
  outcome.report = Examine(outcome.run, *gain, 4);
  return outcome;
}

double OrderShare(const ChannelReport& channel, int order) {
  return channel.orders.at(static_cast<std::size_t>(order - 1)).share;
}

constexpr double kSpeed = RpmToRadPerS(3000.0);

TEST(Innovations, AreWhiteAndAtTheNoiseWhenTheRecordComesFromTheSamePlant) {
  const Outcome outcome = Simulate(Record(test::FlexibleRotor(), kSpeed), kSpeed);
  EXPECT_GT(outcome.run.rows(), kRows / 2);
  for (const auto& channel : outcome.report.channels) {
    // The filter allows for forces that are not there, so that it does a little better than it
    // expects; nothing does better than the reading's own noise (1 % for 1.5 s of it).
    EXPECT_GT(channel.multiple, 0.99);
    EXPECT_LT(channel.multiple, channel.expected_multiple * 1.01);
    EXPECT_LT(std::abs(channel.lag_one), 0.05);
    ASSERT_EQ(channel.orders.size(), 3U);
    for (const auto& order : channel.orders) EXPECT_LT(order.ratio, kDepartureRatio);
    for (const auto& window : channel.windows) EXPECT_NEAR(window.ratio, 1.0, 0.1);
  }
  EXPECT_TRUE(outcome.report.departures.empty());
  for (const auto& channel : outcome.report.channels) {
    ASSERT_FALSE(channel.excitation.empty());
    for (const auto& band : channel.excitation) EXPECT_LT(std::abs(band.sigmas), 5.0);
  }
}

TEST(Innovations, ShowATripledUnbalanceAtOnceTheRotationAndNowhereElse) {
  plant::PlantConfig truth = test::FlexibleRotor();
  for (auto& mass : truth.unbalance) mass.moment_kg_m *= 3.0;
  const Outcome outcome = Simulate(Record(truth, kSpeed), kSpeed);
  for (const auto& channel : outcome.report.channels) {
    EXPECT_GT(channel.multiple, 1.5);
    EXPECT_GT(OrderShare(channel, 1), 0.9);
    EXPECT_LT(OrderShare(channel, 2), 0.02);
    EXPECT_NEAR(channel.dominant_hz, 50.0, outcome.report.line_spacing_hz);
    EXPECT_LT(channel.bands.back().ratio, 1.1);  // 2-5 kHz stays noise
  }
  ASSERT_FALSE(outcome.report.departures.empty());
  EXPECT_EQ(outcome.report.departures.front().place, "1x of rotation");
}

TEST(Innovations, ShowAWeakMagnetInTheChannelsOfItsBearingMostOfAll) {
  plant::PlantConfig truth = test::FlexibleRotor();
  truth.bearings[1].magnet.force_constant_n_m2_per_a2 *= 0.7;
  const Outcome weak = Simulate(Record(truth, 0.0), 0.0);
  const Outcome right = Simulate(Record(test::FlexibleRotor(), 0.0), 0.0);
  const auto excess = [&](std::size_t i) {
    return std::pow(weak.report.channels[i].rms_m, 2) - std::pow(right.report.channels[i].rms_m, 2);
  };
  EXPECT_GT(std::min(excess(2), excess(3)), 0.0);
  EXPECT_GT(std::min(excess(2), excess(3)),
            2.0 * std::max(std::abs(excess(0)), std::abs(excess(1))));
  EXPECT_TRUE(weak.report.channels[0].orders.empty()) << "the rotor stands";
  // The wrong gain leaves what the test current did: seen far beyond chance, far below the noise.
  const auto& bands = weak.report.channels[2].excitation;
  EXPECT_TRUE(std::any_of(bands.begin(), bands.end(), [](const ExcitationReport& band) {
    return band.sigmas > kDepartureSigmas;
  }));
}

TEST(Innovations, FindASensorFaultInTheWindowInWhichItActs) {
  auto rows = Record(test::FlexibleRotor(), kSpeed);
  // A sensor that reads 5 um off in one axis for 50 ms, from 1.5 s on.
  for (std::size_t n = 15'000; n < 15'500; ++n) {
    rows[n].sample.position_m[2] += n % 2 == 0 ? 5e-6 : -5e-6;
  }
  const Outcome outcome = Simulate(rows, kSpeed);
  ASSERT_FALSE(outcome.report.departures.empty());
  const auto& windows = outcome.report.channels[2].windows;
  const auto worst = std::max_element(
      windows.begin(), windows.end(),
      [](const WindowReport& a, const WindowReport& b) { return a.ratio < b.ratio; });
  EXPECT_LE(worst->start_s, 1.55);
  EXPECT_GE(worst->end_s, 1.5);
  EXPECT_GT(worst->ratio, 2.0);
}

TEST(Innovations, FindTheForceThatHoldsUpAWeightTheRotorDoesNotHave) {
  plant::PlantConfig truth = test::FlexibleRotor();
  truth.gravity_m_per_s2 = 0.0;
  const Outcome outcome = Simulate(Record(truth, 0.0), 0.0);
  // The model thinks 2.333 kg hang on it along 225 degrees; the observer must hold it up.
  double sum_x = 0.0;
  for (const std::size_t i : {0U, 2U}) sum_x += outcome.run.unknown_force_n[i];
  const double expected_n = 2.333 * 9.81 / std::sqrt(2.0);
  // 10 %: the sensors stand outboard, so the model's shaft sags by some 5 um between them, and its
  // magnets pull the sagging journals down with ks: another newton to hold.
  EXPECT_NEAR(sum_x, expected_n, 0.1 * expected_n);
  for (const auto& channel : outcome.report.channels) EXPECT_LT(channel.multiple, 1.1);
}

TEST(Innovations, LeaveOutGapsAndWhatTheObserverNeedsToSettleAfterThem) {
  auto rows = Record(test::FlexibleRotor(), kSpeed);
  rows.erase(rows.begin() + 9'000, rows.begin() + 9'700);
  const Outcome outcome = Simulate(rows, kSpeed);
  EXPECT_EQ(outcome.run.gaps, 1U);
  ASSERT_EQ(outcome.run.pieces.size(), 2U);
  EXPECT_EQ(outcome.run.rows() + outcome.run.settling_rows, rows.size());
  // Nothing of the restart is left in what is compared.
  for (const auto& channel : outcome.report.channels) {
    EXPECT_LT(channel.peak_m, 6.0 * channel.rms_m);
    EXPECT_LT(channel.multiple, channel.expected_multiple * 1.02);
  }
}

TEST(Innovations, LeaveOutRowsInWhichTheRotorIsNotLevitated) {
  auto rows = Record(test::FlexibleRotor(), 0.0);
  for (std::size_t n = 0; n < 3'000; ++n) {
    rows[n].levitated = false;
    rows[n].sample.position_m = {150e-6, -150e-6, 150e-6, -150e-6};
  }
  const Outcome outcome = Simulate(rows, 0.0);
  EXPECT_EQ(outcome.run.idle_rows, 3'000U);
  EXPECT_EQ(outcome.run.gaps, 0U);
  for (const auto& channel : outcome.report.channels) EXPECT_LT(channel.multiple, 1.1);
}

TEST(Innovations, RefuseARecordTooShortForASpectrum) {
  auto rows = Record(test::FlexibleRotor(), 0.0);
  rows.resize(50);
  try {
    static_cast<void>(Simulate(rows, 0.0));
    FAIL() << "accepted 50 rows";
  } catch (const BadInput& problem) {
    EXPECT_NE(std::string(problem.what()).find("give a longer record"), std::string::npos);
  }
}

}  // namespace
}  // namespace levitas::analysis
