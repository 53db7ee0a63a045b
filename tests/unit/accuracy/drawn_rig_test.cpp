// Rigs drawn by seed: what the draw promises of magnets, noise, weight and tolerances.

#include "benchmark/accuracy/drawn_rig.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "plant_sim/plant/plant_model.hpp"

namespace levitas::accuracy {
namespace {

constexpr std::uint64_t kSeeds = 200;

const TestRig& Flexible() {
  static const TestRig bench = LoadTestRig("flexible_rotor", {"flexible_rotor"});
  return bench;
}

TestRig Drawn(std::uint64_t seed) {
  Random random(seed);
  return DrawRig(Flexible(), random);
}

/// [N] ki i0
double ForceOf(const plant::MagnetConfig& magnet) {
  return 4.0 * magnet.force_constant_n_m2_per_a2 *
         std::pow(magnet.bias_current_a / magnet.gap_m, 2);
}

TEST(DrawnRig, HasForcesAndNoiseOverTheWholeRange) {
  double least_n = kMostForceN;
  double most_n = kLeastForceN;
  double least_m = kMostNoiseM;
  double most_m = kLeastNoiseM;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const TestRig rig = Drawn(seed);
    for (const plant::BearingConfig& bearing : rig.rig.plant.bearings) {
      const double force_n = ForceOf(bearing.magnet);
      ASSERT_GE(force_n, kLeastForceN * (1.0 - 1e-9)) << seed;
      ASSERT_LE(force_n, kMostForceN * (1.0 + 1e-9)) << seed;
      least_n = std::min(least_n, force_n);
      most_n = std::max(most_n, force_n);
      ASSERT_GE(bearing.sensor.noise_rms_m, kLeastNoiseM) << seed;
      ASSERT_LE(bearing.sensor.noise_rms_m, kMostNoiseM) << seed;
      least_m = std::min(least_m, bearing.sensor.noise_rms_m);
      most_m = std::max(most_m, bearing.sensor.noise_rms_m);
    }
  }
  // None of 200 uniform draws in the lowest or highest twentieth: 3.5e-5 each.
  EXPECT_LT(least_n, kLeastForceN * std::pow(kMostForceN / kLeastForceN, 0.05));
  EXPECT_GT(most_n, kLeastForceN * std::pow(kMostForceN / kLeastForceN, 0.95));
  EXPECT_LT(least_m, kLeastNoiseM * std::pow(kMostNoiseM / kLeastNoiseM, 0.05));
  EXPECT_GT(most_m, kLeastNoiseM * std::pow(kMostNoiseM / kLeastNoiseM, 0.95));
}

TEST(DrawnRig, IsOverhungOrTheFilesOrNeither) {
  std::set<bool> overhung;
  std::size_t shipped = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const plant::PlantConfig plant = Drawn(seed).rig.plant;
    const double last_z_m = plant.bearings.back().actuator_z_m;
    shipped += plant.rotor.sections.size() == Flexible().rig.plant.rotor.sections.size() &&
                       last_z_m == Flexible().rig.plant.bearings.back().actuator_z_m
                   ? 1U
                   : 0U;
    overhung.insert(std::any_of(plant.rotor.discs.begin(), plant.rotor.discs.end(),
                                [last_z_m](const rotor::Disc& d) { return d.z_m > last_z_m; }));
  }
  EXPECT_EQ(overhung.size(), 2U);
  EXPECT_GT(shipped, kSeeds / 8);
  EXPECT_LT(shipped, kSeeds / 2);
}

/// Lowest bending frequency [Hz].
double FirstBending(const plant::PlantConfig& plant) {
  return plant::Reduce(plant).modes.frequency_rad_per_s[2];
}

TEST(DrawnRig, OfTheFilesRotorKeepsItsModes) {
  const double file = FirstBending(Flexible().rig.plant);
  std::size_t seen = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds && seen < 3; ++seed) {
    const plant::PlantConfig plant = Drawn(seed).rig.plant;
    if (plant.bearings.back().actuator_z_m != Flexible().rig.plant.bearings.back().actuator_z_m)
      continue;
    EXPECT_NEAR(FirstBending(plant), file, 1e-6 * file);
    ++seen;
  }
  EXPECT_EQ(seen, 3U);
}

TEST(DrawnRig, IsThatOfItsSeed) {
  const TestRig one = Drawn(7);
  const TestRig same = Drawn(7);
  EXPECT_EQ(ForceOf(one.rig.plant.bearings[0].magnet), ForceOf(same.rig.plant.bearings[0].magnet));
  EXPECT_NE(ForceOf(one.rig.plant.bearings[0].magnet),
            ForceOf(Drawn(8).rig.plant.bearings[0].magnet));
}

TEST(DrawnRig, IsNotDrawnOfGearedShafts) {
  EXPECT_TRUE(CanBeDrawn(Flexible().rig));
  EXPECT_FALSE(CanBeDrawn(LoadTestRig("geared_rotor_4dof", {"geared_rotor"}).rig));
  EXPECT_FALSE(CanBeDrawn(LoadTestRig("turbomolecular_pump", {"turbomolecular_pump"}).rig));
}

}  // namespace
}  // namespace levitas::accuracy
