// A hinge in a shaft that has modes, against the beam equation of a shaft with that hinge.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

#include "plant_sim/effect/crack.hpp"
#include "plant_sim/rotor/finite_element.hpp"
#include "plant_sim/rotor/plane_shape.hpp"

namespace levitas::rotor {
namespace {

constexpr double kLength_m = 0.6;
constexpr double kDiameter_m = 0.006;  // slender: the equation below has no shear
constexpr double kYoung_pa = 2e11;
const double kBending_n_m2 = kYoung_pa * std::numbers::pi / 64.0 * std::pow(kDiameter_m, 4);

/// [rad/(N m)] Of a hinge, from its share of what the whole shaft yields under the same moment.
double Compliance(double share) { return share * kLength_m / kBending_n_m2; }

/// [N m^3]
double Hinge(double share) { return Compliance(share) * kBending_n_m2 * kBending_n_m2; }

/// First bending frequency with the hinge over that without. One half of the free beam,
/// w = A (sin + sinh) + B (cos + cosh) of b x: no shear in the middle, -2 w' = c E I w''.
double ExactShare(double compliance) {
  const double half = 0.5 * kLength_m;
  const auto gap = [&](double b, double c) {
    const double x = b * half;
    const double a1 = -(std::sin(x) + std::sinh(x));
    const double b1 = std::cosh(x) - std::cos(x);
    const double slope =
        b * (a1 * (std::cos(x) + std::cosh(x)) + b1 * (std::sinh(x) - std::sin(x)));
    const double bend =
        b * b * (a1 * (std::sinh(x) - std::sin(x)) + b1 * (std::cosh(x) - std::cos(x)));
    return slope + 0.5 * c * kBending_n_m2 * bend;
  };
  const auto root = [&](double c) {
    double low = 0.5 / kLength_m;
    double high = 5.0 / kLength_m;
    if ((gap(low, c) > 0.0) == (gap(high, c) > 0.0)) throw std::logic_error("no root between");
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      ((gap(middle, c) > 0.0) == (gap(low, c) > 0.0) ? low : high) = middle;
    }
    return low;
  };
  return std::pow(root(compliance) / root(0.0), 2);
}

/// The same of so many modes, softened by `softening_of(R)`; negative where the shaft buckles.
template <class Softening>
double ModalShare(std::size_t modes, Softening softening_of) {
  RotorConfig config;
  config.material = {kYoung_pa, 0.3, 7850.0};
  config.sections = {{kLength_m, kDiameter_m, 0.0}};
  config.max_element_length_m = 0.005;
  const ModalRotor rotor = Reduce(Assemble(config, {0.5 * kLength_m}), modes, 0.003);
  const auto bent = CurvatureAt(rotor, 0.5 * kLength_m);
  const Eigen::Index flexible = rotor.frequency_rad_per_s.size() - rotor.rigid_modes;
  const Eigen::VectorXd w2 = rotor.frequency_rad_per_s.tail(flexible).array().square();
  const Eigen::VectorXd k =
      Eigen::Map<const Eigen::VectorXd>(bent.data(), rotor.frequency_rad_per_s.size())
          .tail(flexible);
  const double residual = (k.array().square() / w2.array()).sum();
  const Eigen::MatrixXd stiffness =
      Eigen::MatrixXd(w2.asDiagonal()) - softening_of(residual) * k * k.transpose();
  const double lowest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness).eigenvalues()[0];
  return std::copysign(std::sqrt(std::abs(lowest) / w2[0]), lowest);
}

constexpr double kShallow = 0.01;
constexpr double kDeep = 0.15;  // depth 0.35 in a shaft eight times as long as thick

TEST(CrackedShaft, HasTheFrequencyOfTheBeamWithAHingeWhateverTheNumberOfModes) {
  for (const double share : {kShallow, 0.05, kDeep}) {
    const double exact = ExactShare(Compliance(share));
    for (const std::size_t modes : {6U, 10U, 20U}) {
      const double found = ModalShare(modes, [share](double residual) {
        return effect::CrackSoftening(Hinge(share), 1.0, residual);
      });
      // 6 %: what four bending modes leave out of a shallow hinge's own bending.
      EXPECT_NEAR((1.0 - found) / (1.0 - exact), 1.0, 0.06) << share << " " << modes;
    }
  }
}

// What the first order in the compliance makes of a deep crack: the more modes, the softer, until
// the shaft buckles.
TEST(CrackedShaft, WouldBuckleByTheFirstOrderInTheCompliance) {
  const auto first_order = [](double) { return Hinge(kDeep); };
  EXPECT_LT(ModalShare(6, first_order), 0.9 * ExactShare(Compliance(kDeep)));
  EXPECT_LT(ModalShare(20, first_order), 0.0);
}

}  // namespace
}  // namespace levitas::rotor
