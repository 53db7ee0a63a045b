// What no force changes: momentum and energy of rigs drawn from seeds, coils without current.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "plant_sim/plant/plant_model.hpp"
#include "tests/loop/physics/random_plant.hpp"

namespace levitas::plant {
namespace {

constexpr double kConservedSpeed_rad_per_s = 250.0;

class Conservation : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, Conservation, testing::Range<std::uint64_t>(1, 9));

Plant Unpowered(const PlantConfig& config, double speed_rad_per_s) {
  Plant plant(config, 1);
  plant.RestInTouchdown();  // without touchdown bearings: in the centre, coils off
  plant.SetSpeed(speed_rad_per_s, 0.0);
  return plant;
}

std::complex<double> Velocity(const Plant& plant, std::size_t mode) {
  return {plant.state()[plant.layout().v_x + mode], plant.state()[plant.layout().v_y + mode]};
}

// Momentum of the tilt mode: q1' - j W (G q)_1. Its rate of change is the outer moment, at constant
// speed; the second part is what the spinning discs carry.
std::complex<double> TiltMomentum(const Plant& plant) {
  const auto& at = plant.layout();
  const auto& g = plant.model().parameters().modes.gyroscopic;
  std::complex<double> carried = 0.0;
  for (std::size_t i = 0; i < at.modes; ++i) {
    carried += g(1, static_cast<Eigen::Index>(i)) *
               std::complex<double>(plant.state()[at.q_x + i], plant.state()[at.q_y + i]);
  }
  return Velocity(plant, 1) - std::complex<double>(0.0, plant.speed_rad_per_s()) * carried;
}

TEST_P(Conservation, OfLinearMomentumHoldsAtAnySpeed) {
  for (const double speed_rad_per_s : {0.0, kConservedSpeed_rad_per_s, -900.0}) {
    Plant plant = Unpowered(RandomFreeRotor(GetParam()), speed_rad_per_s);
    Kick(plant, GetParam());
    const auto before = Velocity(plant, 0);
    for (int i = 0; i < 1000; ++i) plant.Advance(HeldSpeed(speed_rad_per_s));
    // A translation tilts no disc, so nothing acts on it: G's first row is rounding, 1e-12.
    EXPECT_NEAR(std::abs(Velocity(plant, 0) - before), 0.0, 1e-9 * std::abs(before));
  }
}

TEST_P(Conservation, OfAngularMomentumHoldsBetweenShaftAndSpinningDiscs) {
  const auto drift = [&](int substeps) {
    auto config = RandomFreeRotor(GetParam());
    config.substeps = substeps;
    Plant plant = Unpowered(config, kConservedSpeed_rad_per_s);
    Kick(plant, GetParam());
    const auto before = TiltMomentum(plant);
    double largest = 0.0;
    for (int i = 0; i < 500; ++i) {
      plant.Advance(HeldSpeed(kConservedSpeed_rad_per_s));
      largest = std::max(largest, std::abs(TiltMomentum(plant) - before));
    }
    return largest / std::abs(before);
  };
  // The step treats the gyroscopic force as linear between its ends: second order in the substep,
  // times the share of modes that are fast against it.
  const double coarse = drift(4);
  EXPECT_LT(coarse, 2e-2);
  EXPECT_LT(drift(32), coarse / 20.0 + 1e-9);  // 64 for the pure order, 20 with faster modes
}

TEST_P(Conservation, OfEnergyHoldsAtStandstill) {
  Plant plant = Unpowered(RandomFreeRotor(GetParam()), 0.0);
  Kick(plant, GetParam());
  const double before = Energy(plant);
  for (int i = 0; i < 2000; ++i) plant.Advance(HeldSpeed(0.0));
  EXPECT_NEAR(Energy(plant) / before, 1.0, 1e-9);  // exact modes: 8000 roundings
}

TEST_P(Conservation, MaterialDampingOnlyTakesEnergyAndLeavesTheRigidMotionItsOwn) {
  auto config = RandomFreeRotor(GetParam());
  config.rotor.modal_damping_ratio = 0.02;
  Plant plant = Unpowered(config, 0.0);
  Kick(plant, GetParam());
  const double rigid = 0.5 * (std::norm(Velocity(plant, 0)) + std::norm(Velocity(plant, 1)));
  double before = Energy(plant);
  for (int i = 0; i < 5000; ++i) {
    plant.Advance(HeldSpeed(0.0));
    const double now = Energy(plant);
    ASSERT_LE(now, before * (1.0 + 1e-12)) << i;  // rounding
    before = now;
  }
  EXPECT_GE(before, rigid * (1.0 - 1e-9));
}

TEST_P(Conservation, GravityGivesTheMomentumOfTheWeightAndNoMoment) {
  auto config = RandomFreeRotor(GetParam());
  config.gravity_m_per_s2 = 9.81;
  Plant plant = Unpowered(config, 0.0);
  for (int i = 0; i < 500; ++i) plant.Advance(HeldSpeed(0.0));
  const double mass_kg = plant.model().parameters().modes.total_mass_kg;
  // Modal momentum of the translation is sqrt(m) v; 50 ms of free fall.
  const auto expected = std::polar(std::sqrt(mass_kg) * 9.81 * 0.05, config.gravity_direction_rad);
  EXPECT_NEAR(std::abs(Velocity(plant, 0) - expected), 0.0, 1e-9 * std::abs(expected));
  EXPECT_NEAR(std::abs(Velocity(plant, 1)), 0.0, 1e-9 * std::abs(expected));
  // Every point of a shaft without supports falls alike: it does not bend.
  const auto fallen_m = plant.ActuatorPosition();
  EXPECT_NEAR(std::hypot(fallen_m[0], fallen_m[1]), 0.5 * 9.81 * 0.0025, 1e-9);
  EXPECT_NEAR(std::hypot(fallen_m[2], fallen_m[3]), 0.5 * 9.81 * 0.0025, 1e-9);
}

TEST_P(Conservation, AMovingObserverSeesTheSameVibration) {
  // Galilei: the same kick with another velocity of translation differs by v t and nothing else,
  // spinning and unbalanced or not.
  auto config = RandomFreeRotor(GetParam());
  config.unbalance = RandomPlant(GetParam()).unbalance;
  Plant still = Unpowered(config, kConservedSpeed_rad_per_s);
  Kick(still, GetParam());
  Plant moving = still;
  const double mass_kg = still.model().parameters().modes.total_mass_kg;
  moving.mutable_state()[still.layout().v_x] += std::sqrt(mass_kg) * 0.01;  // 10 mm/s along x
  for (int i = 0; i < 500; ++i) {
    still.Advance(HeldSpeed(kConservedSpeed_rad_per_s));
    moving.Advance(HeldSpeed(kConservedSpeed_rad_per_s));
  }
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const double way_m = axis % 2 == 0 ? 0.01 * 0.05 : 0.0;
    EXPECT_NEAR(moving.ActuatorPosition()[axis] - still.ActuatorPosition()[axis], way_m, 1e-12);
  }
}

TEST_P(Conservation, ImpactsOnTheTouchdownBearingsOnlyTakeEnergyFromAStandingRotor) {
  auto config = RandomFreeRotor(GetParam());
  config.substeps = 16;
  for (auto& b : config.bearings) b.touchdown = {190e-6, 2e7, 2000.0, 0.15, 0.012};
  Plant plant = Unpowered(config, 0.0);
  Kick(plant, GetParam());
  const double start = Energy(plant);
  double before = start;
  int impacts = 0;
  for (int i = 0; i < 5000; ++i) {
    plant.Advance(HeldSpeed(0.0));
    if (plant.ContactForce() > 0.0) {
      ++impacts;
      continue;  // some of the energy is in the bearing's spring
    }
    // Free again: what the bearing gave back is less than it took.
    ASSERT_LE(Energy(plant), before * (1.0 + 1e-9)) << i;
    before = Energy(plant);
  }
  EXPECT_GT(impacts, 0);
  EXPECT_LT(before, 0.9 * start);
}

}  // namespace
}  // namespace levitas::plant
