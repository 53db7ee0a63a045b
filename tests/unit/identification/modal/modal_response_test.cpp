#include "identification/modal/modal_response.hpp"
#include "common/rotational_speed.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>

#include "configuration/rig_file.hpp"
#include "numerics/dense/factorisations.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "tests/support/paths.hpp"
#include "tests/unit/identification/modal/shipped_rotor.hpp"

namespace levitas::identification {
namespace {

Eigen::MatrixXcd Exact(double f_hz, double speed_rad_per_s) {
  const auto sampled = plant::Discretise(plant::Linearise(Rig().plant, speed_rad_per_s), 1e-4, 1.0);
  const auto z = std::polar(1.0, 2.0 * std::numbers::pi * f_hz * 1e-4);
  const Eigen::Index n = sampled.a.rows();
  const Eigen::MatrixXcd resolvent = z * Eigen::MatrixXcd::Identity(n, n) - sampled.a;
  return sampled.c * resolvent.partialPivLu().solve(sampled.b.cast<std::complex<double>>());
}

TEST(ModalResponse, IsThatOfTheSampledPlantAtEverySpeed) {
  const ModalStart start = StartFromRig(Rig().plant, 6);  // all that the rig file keeps
  const Physical rig = ToPhysical(start.frame, start.vector);
  for (const double rpm : {0.0, 3000.0}) {
    for (const double f_hz : {7.0, 60.0, 89.0, 300.0, 505.0, 700.0, 900.0}) {
      const Eigen::MatrixXcd exact = Exact(f_hz, RpmToRadPerS(rpm));
      const Eigen::MatrixXcd model = ModalResponse(start.frame, rig, f_hz, RpmToRadPerS(rpm));
      // The images of the hold that the model leaves out, see its header.
      const double mass_line = 80.0 / (2.3 * std::pow(2.0 * std::numbers::pi * f_hz, 2.0));
      EXPECT_LT((exact - model).cwiseAbs().maxCoeff(), 1e-3 * mass_line) << f_hz << " Hz " << rpm;
    }
  }
}

TEST(ModalResponse, DerivativesAreThoseOfFiniteDifferences) {
  const ModalStart start = StartFromRig(Rig().plant, 5);
  for (const double speed : {0.0, RpmToRadPerS(3000.0)}) {
    const double f_hz = 95.0;
    ResponseDerivative derivative;
    (void)ModalResponse(start.frame, ToPhysical(start.frame, start.vector), f_hz, speed,
                        &derivative);
    for (Eigen::Index k = 0; k < start.vector.size(); ++k) {
      constexpr double kStep = 1e-6;
      Eigen::VectorXd above = start.vector;
      Eigen::VectorXd below = start.vector;
      above[k] += kStep;
      below[k] -= kStep;
      const Eigen::MatrixXcd difference =
          (ModalResponse(start.frame, ToPhysical(start.frame, above), f_hz, speed) -
           ModalResponse(start.frame, ToPhysical(start.frame, below), f_hz, speed)) /
          (2.0 * kStep);
      const Eigen::Map<const Eigen::MatrixXcd> expected(derivative.col(k).data(), 4, 4);
      // Rounding of the difference: 1e-16 / 1e-6 of the response, with a curvature of order one.
      EXPECT_LT((difference - expected).cwiseAbs().maxCoeff(),
                1e-6 * (difference.cwiseAbs().maxCoeff() + 1e-5))
          << start.names[static_cast<std::size_t>(k)] << " at " << speed;
    }
  }
}

TEST(ModalParameters, CountTheUnknownsOfThePaper) {
  // 5 bending modes: 3 of the rigid body, 5 + 5 + 20 of the modes, 4 ki, 4 ks, 4 gains, 1 delay.
  const ModalLayout layout(2, 5);
  EXPECT_EQ(layout.amplifier, 46);
  EXPECT_EQ(layout.size - layout.gyroscopic, 21);
}

TEST(ModalParameters, TakeMassAndInertiaFromTheRigFile) {
  const ModalStart start = StartFromRig(Rig().plant, 4);
  const Physical rig = ToPhysical(start.frame, start.vector);
  EXPECT_NEAR(rig.mass_kg, 2.333, 5e-4);  // printed with four digits in the description of the rig
  EXPECT_NEAR(rig.ki_n_per_a[0], 40.0, 1e-9);
  EXPECT_NEAR(rig.ks_n_per_m[3], 40.0 / 0.381e-3, 1e-4);
}

}  // namespace
}  // namespace levitas::identification
