#pragma once
// The rig of the identification's loop tests, and its response in closed form.

#include <Eigen/LU>
#include <algorithm>
#include <complex>
#include <numbers>
#include <vector>

#include "configuration/rig_file.hpp"
#include "numerics/dense/factorisations.hpp"
#include "plant_sim/plant/linear_model.hpp"

namespace levitas::identification {

inline const configuration::RigFile& FlexibleRotor() {
  static const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  return rig;
}

/// Of the sampled linear model standing, delay and hold included [m/A].
inline Eigen::MatrixXcd Exact(double f_hz) {
  static const auto sampled =
      plant::Discretise(plant::Linearise(FlexibleRotor().plant, 0.0), 1e-4, 1.0);
  const auto z = std::polar(1.0, 2.0 * std::numbers::pi * f_hz * 1e-4);
  const Eigen::Index n = sampled.a.rows();
  const Eigen::MatrixXcd resolvent = z * Eigen::MatrixXcd::Identity(n, n) - sampled.a;
  return sampled.c * resolvent.partialPivLu().solve(sampled.b.cast<std::complex<double>>());
}

inline double Median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace levitas::identification
