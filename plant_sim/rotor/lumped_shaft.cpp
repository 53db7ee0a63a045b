#include "plant_sim/rotor/lumped_shaft.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

#include "numerics/dense/eigenvalues.hpp"

namespace levitas::rotor {

void SetSimplySupported(LumpedShaft& shaft, double span_m, double bending_stiffness_n_m2) {
  const double a = shaft.z_m;
  const double b = span_m - a;
  if (!(a > 0.0 && b > 0.0 && bending_stiffness_n_m2 > 0.0)) {
    throw std::invalid_argument(
        fmt::format("shaft: disc at {} m of a span of {} m with EI = {} N m^2; the disc must lie "
                    "between the ends, EI be > 0",
                    a, span_m, bending_stiffness_n_m2));
  }
  const double factor = 1.0 / (3.0 * bending_stiffness_n_m2 * span_m);
  const double yy = a * a * b * b * factor;
  const double ya = a * b * (b - a) * factor;
  const double aa = (a * a - a * b + b * b) * factor;
  const double determinant = yy * aa - ya * ya;
  shaft.tilts = true;
  shaft.kll_n_per_m = aa / determinant;
  shaft.kla_n = -ya / determinant;
  shaft.kaa_n_m = yy / determinant;
}

LumpedShaft CondenseTilt(const LumpedShaft& shaft) {
  if (!shaft.tilts) return shaft;
  LumpedShaft stiff = shaft;
  const double td = -shaft.kla_n / shaft.kaa_n_m;
  stiff.tilts = false;
  stiff.mass_kg += td * td * shaft.diametral_inertia_kg_m2;
  stiff.kll_n_per_m += td * shaft.kla_n;
  stiff.kla_n = stiff.kaa_n_m = 0.0;
  stiff.diametral_inertia_kg_m2 = stiff.polar_inertia_kg_m2 = 0.0;
  return stiff;
}

ModalRotor Reduce(const LumpedShaft& shaft) {
  const Eigen::Index size = shaft.tilts ? 2 : 1;
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd stiffness = mass;
  Eigen::MatrixXd gyroscopic = mass;
  mass(0, 0) = shaft.mass_kg;
  stiffness(0, 0) = shaft.kll_n_per_m;
  if (shaft.tilts) {
    mass(1, 1) = shaft.diametral_inertia_kg_m2;
    gyroscopic(1, 1) = shaft.polar_inertia_kg_m2;
    stiffness(0, 1) = stiffness(1, 0) = shaft.kla_n;
    stiffness(1, 1) = shaft.kaa_n_m;
  }
  if (!(mass.diagonal().minCoeff() > 0.0)) {
    throw std::invalid_argument(
        fmt::format("shaft: mass {} kg and diametral inertia {} kg m^2 must be > 0", shaft.mass_kg,
                    shaft.diametral_inertia_kg_m2));
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass);
  if (!(solver.eigenvalues()[0] > 0.0)) {
    throw std::invalid_argument("shaft: the stiffness of deflection and tilt holds no disc");
  }
  const Eigen::MatrixXd& phi = solver.eigenvectors();
  ModalRotor modal;
  modal.frequency_rad_per_s = solver.eigenvalues().cwiseSqrt();
  modal.damping_ratio = Eigen::VectorXd::Zero(size);
  modal.gyroscopic = phi.transpose() * gyroscopic * phi;
  modal.shapes = phi.row(0);
  modal.slopes = size == 2 ? Eigen::MatrixXd(phi.row(1)) : Eigen::MatrixXd::Zero(1, size);
  modal.node_z_m = {shaft.z_m};
  modal.total_mass_kg = shaft.mass_kg;
  return modal;
}

}  // namespace levitas::rotor
