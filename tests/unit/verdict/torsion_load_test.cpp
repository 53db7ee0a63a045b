// What a verdict says of measured couplings: rms, peak and when, of the turning rotor alone.
#include "verdict/torsion_load.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/two_pi.hpp"

namespace levitas::verdict {
namespace {

constexpr double kPeriodS = 1e-4;
constexpr std::uint64_t kCycles = 3200;
constexpr std::uint64_t kStands = 1600;  // the first cycles
constexpr double kSpeed = 100.0;

TorsionLoads Loads() {
  TorsionLoads loads(1.0, 0.0, kPeriodS);
  for (std::uint64_t cycle = 0; cycle < kCycles; ++cycle) {
    cycle::CycleRecord record;
    record.in.cycle = cycle;
    record.in.frame_present = true;
    record.in.frame.cycle = cycle + 50;  // the rig had counted before
    record.in.frame.rig_session = 1;
    record.in.frame.speed_rad_per_s = cycle < kStands ? 0.0 : kSpeed;
    record.out.mode = cycle < kStands ? Mode::kLevitating : Mode::kSpinning;
    loads.Add(record);
  }
  return loads;
}

/// Coupling 0: 10 N m standing, a sine of 2 N m turning with one value of -5 N m; coupling 1: half.
std::vector<TorsionBatch> Batches(std::uint64_t spike) {
  std::vector<TorsionBatch> batches;
  for (std::uint64_t first = 0; first < kCycles; first += kTorsionSamples) {
    TorsionBatch batch{
        .first_cycle = first + 50, .rig_session = 1, .couplings = 2, .samples = kTorsionSamples};
    for (std::size_t s = 0; s < kTorsionSamples; ++s) {
      const std::uint64_t cycle = first + s;
      double torque =
          cycle < kStands ? 10.0 : 2.0 * std::sin(kTwoPi * 0.01 * static_cast<double>(cycle));
      if (cycle == spike) torque = -5.0;
      batch.torque_n_m[2 * s] = torque;
      batch.torque_n_m[2 * s + 1] = 0.5 * torque;
      batch.twist_rad[2 * s] = 1e-3 * torque;
      batch.twist_rad[2 * s + 1] = 1e-4 * torque;
    }
    batches.push_back(batch);
  }
  return batches;
}

TEST(TorsionLoads, AreThoseOfTheTurningRotor) {
  constexpr std::uint64_t kSpike = 2000;
  const auto found = Loads().Of(Batches(kSpike), {"motor to pinion", "gear to brake"});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].coupling, "motor to pinion");
  EXPECT_EQ(found[0].samples, kCycles - kStands);
  // A sine of 2 N m over whole periods: mean square 2, and 25 in place of the sine's 0.
  EXPECT_NEAR(found[0].torque_rms_n_m, std::sqrt(2.0 + 25.0 / (kCycles - kStands)), 1e-9);
  EXPECT_DOUBLE_EQ(found[0].torque_peak_n_m, 5.0);
  EXPECT_NEAR(found[0].peak_time_s, kSpike * kPeriodS, 1e-12);
  EXPECT_NEAR(found[0].peak_speed_rad_per_s, kSpeed, 1e-4);
  EXPECT_DOUBLE_EQ(found[0].twist_peak_rad, 5e-3);
  EXPECT_DOUBLE_EQ(found[1].torque_peak_n_m, 2.5);
  EXPECT_DOUBLE_EQ(found[1].twist_peak_rad, 5e-4);
}

TEST(TorsionLoads, ThatWereNotMeasuredWhileTurningAreLeftOut) {
  auto batches = Batches(0);
  batches.resize(kStands / kTorsionSamples);
  EXPECT_TRUE(Loads().Of(batches, {"motor to pinion", "gear to brake"}).empty());
  EXPECT_TRUE(Loads().Of({}, {"motor to pinion"}).empty());
}

TEST(TorsionLoads, OfAnotherStartOfTheRigAreNotTakenForThisOne) {
  auto batches = Batches(2000);
  for (TorsionBatch& batch : batches) batch.rig_session = 2;
  EXPECT_TRUE(Loads().Of(batches, {"motor to pinion", "gear to brake"}).empty());
}

}  // namespace
}  // namespace levitas::verdict
