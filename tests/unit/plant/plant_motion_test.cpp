// Motion of the plant against closed forms: energy, unbalance, gravity, convergence.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>

#include "common/random.hpp"
#include "numerics/dense/factorisations.hpp"
#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

constexpr double kSpeed_rad_per_s = 314.0;

PlantCommand OffAt(double speed_rad_per_s) {
  PlantCommand command;
  command.amplifiers_enabled = false;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = speed_rad_per_s;
  command.acceleration_limit_rad_per_s2 = 1000.0;
  return command;
}

// Without gravity RestInTouchdown leaves the rotor in the centre, without current: free.
Plant FreeRotor(const PlantConfig& config, double speed_rad_per_s) {
  Plant plant(config, 1);
  plant.RestInTouchdown();
  plant.SetSpeed(speed_rad_per_s, 0.0);
  return plant;
}

double Energy(const Plant& plant) {
  const auto& at = plant.layout();
  const auto& w = plant.model().parameters().modes.frequency_rad_per_s;
  double sum = 0.0;
  for (std::size_t i = 0; i < 2 * at.modes; ++i) {
    const double frequency = w[static_cast<Eigen::Index>(i % at.modes)];
    const double strain = frequency * plant.state()[at.q_x + i];
    const double velocity = plant.state()[at.v_x + i];
    sum += 0.5 * (strain * strain + velocity * velocity);
  }
  return sum;
}

double EnergyAfterOneSecond(double speed_rad_per_s, int substeps) {
  auto config = test::QuietFlexibleRotor();
  config.rotor.modal_damping_ratio = 0.0;
  config.substeps = substeps;
  config.unbalance.clear();
  Plant plant = FreeRotor(config, speed_rad_per_s);
  Random random(20261121);
  for (std::size_t i = plant.layout().v_x; i < plant.layout().coil_current; ++i) {
    plant.mutable_state()[i] = 1e-3 * random.Normal();
  }
  const double before = Energy(plant);
  for (int i = 0; i < 10'000; ++i) plant.Advance(OffAt(speed_rad_per_s));
  return Energy(plant) / before;
}

TEST(FreeRotor, KeepsItsEnergyAtStandstill) {
  EXPECT_NEAR(EnergyAfterOneSecond(0.0, 4), 1.0, 1e-10);  // exact modes: 40 000 roundings
}

TEST(FreeRotor, KeepsItsEnergyWhileTurningBecauseGyroscopicForcesDoNoWork) {
  // The step treats them to second order, so some energy is made. 0.2 % in a second is a damping
  // ratio of -1e-7 at 1660 Hz, against +3e-3 of the material; it falls with the cube of the
  // substep.
  const double made = EnergyAfterOneSecond(kSpeed_rad_per_s, 4) - 1.0;
  EXPECT_LT(std::abs(made), 2e-3);
  EXPECT_NEAR(made / (EnergyAfterOneSecond(kSpeed_rad_per_s, 8) - 1.0), 8.0, 1.0);
}

TEST(Unbalance, MovesARigidRotorAboutItsCentreOfMassWhileItAccelerates) {
  // r + (u/m) e^{j angle} is the centre of mass; no force acts on it, so it stays where it is, at
  // any speed and acceleration. This needs W^2 and dW/dt alike.
  auto config = test::RigidRotor(2.0);
  config.unbalance = {{0.05, 10e-6, 0.4}, {0.15, 10e-6, 0.4}};
  config.drive.max_acceleration_rad_per_s2 = 1000.0;
  const double orbit_m = 20e-6 / 2.0;
  Plant plant(config, 1);
  plant.RestInTouchdown();
  plant.PlaceAtRest({-orbit_m * std::cos(0.4), -orbit_m * std::sin(0.4), -orbit_m * std::cos(0.4),
                     -orbit_m * std::sin(0.4)});
  const auto placed = std::vector<double>(plant.state().begin(), plant.state().end());
  plant.RestInTouchdown();  // takes the current away ...
  for (std::size_t i = 0; i < 4; ++i) plant.mutable_state()[i] = placed[i];  // ... and the place
  for (int i = 0; i < 3000; ++i) {
    plant.Advance(OffAt(300.0));  // 0.3 s up to 300 rad/s
    const auto position_m = plant.ActuatorPosition();
    // Trapezoid on a force that turns by W h = 7.5e-3 per substep: (W h)^2/12 = 5e-6 of the orbit,
    // summed over the run-up by two integrations; 1 % is far below what a missing term leaves.
    ASSERT_NEAR(position_m[0], -orbit_m * std::cos(plant.angle_rad() + 0.4), 0.01 * orbit_m) << i;
    ASSERT_NEAR(position_m[1], -orbit_m * std::sin(plant.angle_rad() + 0.4), 0.01 * orbit_m) << i;
  }
  EXPECT_DOUBLE_EQ(plant.speed_rad_per_s(), 300.0);
}

TEST(Unbalance, HoldsAFlexibleRotorInTheSteadyWhirlOfTheClosedForm) {
  // Q = (w^2 - W^2 + 2 j z w W + W^2 G)^-1 U W^2,  r = Q e^{j W t}: docs/derivations.md (10), (13).
  const auto config = test::QuietFlexibleRotor();
  Plant plant = FreeRotor(config, kSpeed_rad_per_s);
  const auto& modes = plant.model().parameters().modes;
  const auto n = static_cast<Eigen::Index>(plant.layout().modes);
  Eigen::VectorXcd force(n);
  Eigen::MatrixXcd dynamic =
      (kSpeed_rad_per_s * kSpeed_rad_per_s * modes.gyroscopic).cast<std::complex<double>>();
  for (Eigen::Index i = 0; i < n; ++i) {
    const double w = modes.frequency_rad_per_s[i];
    dynamic(i, i) += std::complex<double>(w * w - kSpeed_rad_per_s * kSpeed_rad_per_s,
                                          2.0 * modes.damping_ratio[i] * w * kSpeed_rad_per_s);
    force[i] = 0.0;
    for (const auto& mass : config.unbalance) {
      force[i] += modes.ShapeAt(mass.z_m)[i] * mass.moment_kg_m * kSpeed_rad_per_s *
                  kSpeed_rad_per_s * std::polar(1.0, mass.phase_rad);
    }
  }
  const Eigen::VectorXcd whirl = dynamic.partialPivLu().solve(force);
  const auto& at = plant.layout();
  for (std::size_t i = 0; i < at.modes; ++i) {
    const std::complex<double> q = whirl[static_cast<Eigen::Index>(i)];
    plant.mutable_state()[at.q_x + i] = q.real();
    plant.mutable_state()[at.q_y + i] = q.imag();
    plant.mutable_state()[at.v_x + i] = -kSpeed_rad_per_s * q.imag();
    plant.mutable_state()[at.v_y + i] = kSpeed_rad_per_s * q.real();
  }
  for (int step = 0; step < 200; ++step) plant.Advance(OffAt(kSpeed_rad_per_s));
  const std::complex<double> turn = std::polar(1.0, kSpeed_rad_per_s * 0.02);
  for (std::size_t i = 0; i < at.modes; ++i) {
    const std::complex<double> q = whirl[static_cast<Eigen::Index>(i)] * turn;
    // One turn; the trapezoid leaves (W h)^2/12 = 5e-6 per unit of force, integrated twice.
    EXPECT_NEAR(plant.state()[at.q_x + i], q.real(), 1e-3 * whirl.norm()) << i;
    EXPECT_NEAR(plant.state()[at.q_y + i], q.imag(), 1e-3 * whirl.norm()) << i;
  }
}

TEST(Gravity, PullsAFreeRotorDownTheWrittenDirection) {
  auto config = test::RigidRotor(2.0);
  config.gravity_m_per_s2 = 9.81;
  config.gravity_direction_rad = 225.0 * 3.14159265358979 / 180.0;
  Plant plant(config, 1);
  plant.RestInTouchdown();  // no touchdown bearings: stays in the centre, coils without current
  for (int i = 0; i < 50; ++i) plant.Advance(OffAt(0.0));
  const double fall_m = 0.5 * 9.81 * 0.005 * 0.005;
  for (const double position_m : plant.ActuatorPosition()) {
    if (position_m == 0.0) continue;  // entries beyond the four axes
    EXPECT_NEAR(position_m, -fall_m * std::sqrt(0.5), 1e-6 * fall_m);  // exact for constant force
  }
}

TEST(Levitation, SagsUnderTheWeightAsTheStiffnessSays) {
  // ic = -Kp y - Kd dy/dt: static sag m g / (2 (ki Kp - ks)) per bearing; small enough that the
  // magnet is linear (sag/s0)^2 = 1e-6.
  auto config = test::RigidRotor(2.0);
  config.gravity_m_per_s2 = 0.1;
  config.gravity_direction_rad = 0.0;
  Plant plant(config, 1);
  PlantCommand command;
  command.bias_current_a = 1.0;
  AxisArray last_m{};
  constexpr double kStiff_a_per_m = 8000.0;
  for (int i = 0; i < 20'000; ++i) {
    const auto position_m = plant.Sample().position_m;
    for (std::size_t a = 0; a < 4; ++a) {
      command.control_current_a[a] =
          -kStiff_a_per_m * position_m[a] - 12.0 * (position_m[a] - last_m[a]) * 1e4;
      last_m[a] = position_m[a];
    }
    plant.Advance(command);
  }
  const double stiffness = 40.0 * kStiff_a_per_m - 40.0 * 1.0 / 0.381e-3;
  EXPECT_NEAR(plant.ActuatorPosition()[0] / (2.0 * 0.1 / (2.0 * stiffness)), 1.0, 1e-4);
  EXPECT_NEAR(plant.ActuatorPosition()[2] / (2.0 * 0.1 / (2.0 * stiffness)), 1.0, 1e-4);
  EXPECT_NEAR(plant.MagnetForce()[0], -0.1, 1e-5);  // half the weight of 2 kg at 0.1 m/s^2
}

std::vector<double> StateAfterRelease(int substeps) {
  auto config = test::QuietFlexibleRotor();
  config.substeps = substeps;
  Plant plant(config, 1);
  plant.PlaceAtRest({60e-6, 0.0, 0.0, 30e-6});
  plant.SetSpeed(kSpeed_rad_per_s, 0.0);
  PlantCommand command;
  command.bias_current_a = 1.0;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = kSpeed_rad_per_s;
  for (int i = 0; i < 20; ++i) {
    for (std::size_t a = 0; a < 4; ++a) {
      command.control_current_a[a] = std::sin(0.5 * i + static_cast<double>(a));
    }
    plant.Advance(command);
  }
  return {plant.state().begin(), plant.state().begin() + 16};
}

TEST(TimeStep, ConvergesWithTheSquareOfTheSubstep) {
  const auto exact = StateAfterRelease(512);
  const auto error = [&](int substeps) {
    const auto state = StateAfterRelease(substeps);
    double sum = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) sum += std::pow(state[i] - exact[i], 2);
    return std::sqrt(sum);
  };
  // Second order: halving the substep divides the error by 4, up to terms of the next order.
  EXPECT_NEAR(error(4) / error(8), 4.0, 0.4);
  EXPECT_NEAR(error(8) / error(16), 4.0, 0.2);
}

}  // namespace
}  // namespace levitas::plant
