// Gauges of a geared rig's couplings: what they read, their noise, and that the rig does not feel
// them.
#include "plant_sim/loop/torsion_gauge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/geared_rigs.hpp"

namespace levitas::plant_run {
namespace {

constexpr double kTorqueNoise = 0.02;
constexpr double kTwistNoise = 3e-6;

plant::PlantConfig Rig(double torque_noise, double twist_noise) {
  plant::PlantConfig rig = test::GearedRotor12();
  for (rotor::Shaft& shaft : rig.shafts) shaft.torsion.gauges = {true, torque_noise, twist_noise};
  return rig;
}

std::size_t Couplings(const plant::PlantConfig& rig) {
  return rotor::GaugedCouplings(rig.shafts).size();
}

TEST(TorsionGauge, ReadsTorqueAsStiffnessTimesTwistOfATurningRig) {
  const plant::PlantConfig rig = Rig(0.0, 0.0);
  plant::Plant plant(rig, 1);
  plant.SetSpeed(100.0, 0.0);
  TorsionGauge gauge(plant.model(), 1);
  ASSERT_TRUE(gauge.fitted());
  ASSERT_EQ(Couplings(rig), 2U);
  const std::vector<double> stiffness{rig.shafts[0].torsion.inertias[0].stiffness_n_m_per_rad,
                                      rig.shafts[1].torsion.inertias[0].stiffness_n_m_per_rad};
  const plant::ShaftLoads loads(plant.model());
  double largest = 0.0;
  for (std::uint64_t cycle = 0; cycle < 2 * kTorsionSamples; ++cycle) {
    const auto torques = loads.Torques(plant);
    const TorsionBatch* batch = gauge.Sample(plant, cycle, 7);
    ASSERT_EQ(batch != nullptr, cycle % kTorsionSamples == kTorsionSamples - 1) << cycle;
    if (batch != nullptr) {
      EXPECT_EQ(batch->first_cycle, cycle + 1 - kTorsionSamples);
      EXPECT_EQ(batch->rig_session, 7U);
      ASSERT_EQ(batch->samples, kTorsionSamples);
      for (std::size_t c = 0; c < 2; ++c) {
        const std::size_t last = 2 * (kTorsionSamples - 1) + c;
        EXPECT_DOUBLE_EQ(batch->torque_n_m[last], torques[c]);
        EXPECT_NEAR(batch->torque_n_m[last], stiffness[c] * batch->twist_rad[last],
                    1e-12 * std::abs(torques[c]));
        largest = std::max(largest, std::abs(torques[c]));
      }
    }
    plant.Advance({.bias_current_a = 1.0});
  }
  EXPECT_GT(largest, 1e-3);  // the teeth do turn the wheels: nothing was compared with nothing
}

TEST(TorsionGauge, AddsNoiseOfTheStatedSizeThatTheRigDoesNotFeel) {
  plant::Plant quiet(Rig(0.0, 0.0), 3);
  plant::Plant noisy(Rig(kTorqueNoise, kTwistNoise), 3);
  TorsionGauge exact(quiet.model(), 3);
  TorsionGauge gauge(noisy.model(), 3);
  double torque2 = 0.0;
  double twist2 = 0.0;
  double count = 0.0;
  for (std::uint64_t cycle = 0; cycle < 100 * kTorsionSamples; ++cycle) {
    ASSERT_EQ(quiet.Sample().position_m, noisy.Sample().position_m);
    const TorsionBatch* truth = exact.Sample(quiet, cycle, 1);
    const TorsionBatch* read = gauge.Sample(noisy, cycle, 1);
    if (truth == nullptr || read == nullptr) continue;
    for (std::size_t i = 0; i < 2 * kTorsionSamples; ++i, count += 1.0) {
      torque2 += std::pow(read->torque_n_m[i] - truth->torque_n_m[i], 2);
      twist2 += std::pow(read->twist_rad[i] - truth->twist_rad[i], 2);
    }
  }
  // 6400 samples: a standard deviation of 0.9 %.
  EXPECT_NEAR(std::sqrt(torque2 / count), kTorqueNoise, 0.045 * kTorqueNoise);
  EXPECT_NEAR(std::sqrt(twist2 / count), kTwistNoise, 0.045 * kTwistNoise);
}

TEST(TorsionGauge, EndsABatchAtASkippedInstant) {
  plant::Plant plant(Rig(0.0, 0.0), 1);
  TorsionGauge gauge(plant.model(), 1);
  for (std::uint64_t cycle = 10; cycle < 15; ++cycle) {
    ASSERT_EQ(gauge.Sample(plant, cycle, 1), nullptr);
  }
  const TorsionBatch* batch = gauge.Sample(plant, 17, 1);
  ASSERT_NE(batch, nullptr);
  EXPECT_EQ(batch->first_cycle, 10U);
  EXPECT_EQ(batch->samples, 5U);
  for (std::uint64_t cycle = 18; cycle < 17 + kTorsionSamples - 1; ++cycle) {
    ASSERT_EQ(gauge.Sample(plant, cycle, 1), nullptr);
  }
  batch = gauge.Sample(plant, 17 + kTorsionSamples - 1, 1);
  ASSERT_NE(batch, nullptr);
  EXPECT_EQ(batch->first_cycle, 17U);
}

TEST(TorsionGauge, IsNotThereWithoutGaugesAndRefusesMoreThanARecordHolds) {
  const plant::PlantConfig without = test::GearedRotor12();
  EXPECT_FALSE(TorsionGauge(plant::PlantModel(without), 1).fitted());
  plant::PlantConfig many = Rig(0.0, 0.0);
  auto& inertias = many.shafts[0].torsion.inertias;
  while (inertias.size() < kMaxCouplings + 1) inertias.insert(inertias.begin(), inertias.front());
  many.shafts[0].torsion.gear_at = inertias.size() - 1;
  EXPECT_THROW((void)TorsionGauge(plant::PlantModel(many), 1), std::invalid_argument);
}

}  // namespace
}  // namespace levitas::plant_run
