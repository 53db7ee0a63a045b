// Conservation: without damping the energy of the geared shafts changes by the work done on them.

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "plant_sim/plant/train_linear.hpp"
#include "tests/loop/gears/gear_motion.hpp"
#include "tests/support/geared_rigs.hpp"

namespace levitas::test {
namespace {

// No loss of any kind, and nothing that does work: no run-out, unbalance, transmission error.
plant::PlantConfig Lossless(plant::PlantConfig config) {
  for (auto& shaft : config.shafts) {
    shaft.lumped.damping_n_s_per_m = 0.0;
    shaft.torsion.damping_ratio = 0.0;
    for (auto& inertia : shaft.torsion.inertias) inertia.ground_damping_n_m_s_per_rad = 0.0;
  }
  for (auto& pair : config.gears) {
    pair.damping_n_s_per_m = 0.0;
    pair.driving.runout_m = pair.driven.runout_m = 0.0;
    pair.transmission_error.clear();
  }
  return config;
}

// Kinetic energy of all modal coordinates, strain of shafts and of the mesh.
double Energy(const plant::Plant& plant) {
  const plant::PlantModel& model = plant.model();
  const auto count = static_cast<Eigen::Index>(model.coordinates());
  const auto state = plant.state();
  const Eigen::Map<const Eigen::VectorXd> q(state.data(), count);
  const Eigen::Map<const Eigen::VectorXd> v(state.data() + count, count);
  // The linear model's stiffness, magnets without current, is exact here: everything is linear.
  const Eigen::MatrixXd stiffness = -plant::Linearise(model, 0.0).a.block(count, 0, count, count);
  return 0.5 * v.dot(v) + 0.5 * q.dot(stiffness * q);
}

// Without magnets: their negative stiffness belongs to the linear model at its design bias.
plant::PlantConfig Unmagnetised(plant::PlantConfig config) {
  for (auto& bearing : config.bearings) bearing.magnet.bias_current_a = 0.0;
  return config;
}

void Kick(plant::Plant& plant) {
  const plant::StateLayout& at = plant.layout();
  double push = 1e-3;
  for (std::size_t i = at.v_x; i < at.coil_current; ++i) {
    plant.mutable_state()[i] = push;
    push = -0.8 * push;
  }
}

double Drift(const plant::PlantConfig& config, double speed_rad_per_s, double time_s) {
  plant::Plant plant(Unmagnetised(config), 1);
  plant.SetSpeed(speed_rad_per_s, 0.0);
  Kick(plant);
  const double start = Energy(plant);
  for (long n = std::lround(time_s / 1e-4); n > 0; --n) plant.Advance(Passive(speed_rad_per_s));
  return Energy(plant) / start - 1.0;
}

TEST(Energy, OfUndampedGearedShaftsIsKept) {
  // The exponential trapezoid is of second order: the coupling at the mesh (k h^2/m = 8e-4) makes
  // a few parts in 1e5 within a second, and a sixteenth of that per halving... two halvings.
  for (const auto& config : {GearedRotor4(), GearedRotor8(), GearedRotor12()}) {
    auto fine = Lossless(config);
    const double coarse = Drift(fine, 0.0, 1.0);
    fine.substeps = 16;
    EXPECT_LT(std::abs(coarse), 1e-2);
    EXPECT_LT(std::abs(Drift(fine, 0.0, 1.0)), 1e-4);
  }
}

TEST(Energy, IsNotTouchedByGyroscopicMoments) {
  auto config = Lossless(GearedRotor8());
  config.substeps = 16;
  EXPECT_LT(std::abs(Drift(config, 2.0 * std::numbers::pi * 25.0, 1.0)), 1e-4);
}

TEST(Energy, FallsThroughTheDampingOfTheMesh) {
  auto config = Lossless(GearedRotor4());
  config.gears[0].damping_n_s_per_m = 300.0;
  EXPECT_LT(Drift(config, 0.0, 0.05), -0.1);
}

TEST(Energy, OfDrivenShaftsGrowsByTheWorkOfTheTransmissionError) {
  // d E/dt = f . (d/dt of what is prescribed), f the force between the teeth: with one harmonic of
  // the error and nothing else prescribed.
  auto config = Unmagnetised(Lossless(GearedRotor4()));
  config.substeps = 16;
  config.gears[0].transmission_error = {{1, 5e-6, 0.0}};
  constexpr double kSpeed = 2.0 * std::numbers::pi * 5.0;
  constexpr double kMesh = 20.0 * kSpeed;
  plant::Plant plant(config, 1);
  plant.SetSpeed(kSpeed, 0.0);
  const auto row_x = plant::MeshRow(plant.model(), 0, 1.0, 0.0);
  const auto row_y = plant::MeshRow(plant.model(), 0, 0.0, 1.0);
  const auto count = static_cast<Eigen::Index>(plant.model().coordinates());
  double work_j = 0.0;
  double last_w = 0.0;
  double most_j = 0.0;
  constexpr int kPeriods = 2000;
  for (int n = 0; n <= kPeriods; ++n) {
    const Eigen::Map<const Eigen::VectorXd> q(plant.state().data(), count);
    const Complex e = 5e-6 * std::polar(1.0, kMesh * 1e-4 * n);
    const Complex rate = Complex(0.0, kMesh) * e;
    const Complex force = 1e6 * (Complex(row_x * q, row_y * q) - e);
    const double power_w = -(force.real() * rate.real() + force.imag() * rate.imag());
    if (n > 0) work_j += 0.5e-4 * (power_w + last_w);
    last_w = power_w;
    // All energy, the mesh's with the error in it.
    const double strain_j = 0.5e6 * (std::norm(Complex(row_x * q, row_y * q) - e) -
                                     std::norm(Complex(row_x * q, row_y * q)));
    const double energy_j = Energy(plant) + strain_j;
    const double start_j = 0.5e6 * 25e-12;  // at rest, the error at its full 5 um
    most_j = std::max(most_j, std::abs(energy_j));
    // Trapezoid of a power at 100 Hz in steps of 100 us: (w h)^2/12 = 3e-4 of the exchanged energy.
    if (n == kPeriods) {
      EXPECT_NEAR(energy_j - start_j, work_j, 0.005 * most_j);
    }
    plant.Advance(Passive(kSpeed));
  }
}

}  // namespace
}  // namespace levitas::test
