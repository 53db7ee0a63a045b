#include "design/synthesis/hinf_norm.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/problem.hpp"
#include "design/synthesis/hamiltonian.hpp"
#include "design/synthesis/singular_value.hpp"

namespace levitas::synthesis {

namespace {

void Raise(const StateSpace& system, double rad_per_s, HinfNorm& norm) {
  const double value = LargestSingularValue(Response(system, rad_per_s));
  if (!(value > norm.lower)) return;
  norm.lower = value;
  norm.rad_per_s = rad_per_s;
}

/// Frequencies at which peaks are likely: zero, infinity, and those of the poles.
HinfNorm FirstGuess(const StateSpace& system, const Eigen::VectorXcd& poles) {
  HinfNorm norm;
  norm.rad_per_s = std::numeric_limits<double>::infinity();
  norm.lower = LargestSingularValue(Response(system, norm.rad_per_s));
  Raise(system, 0.0, norm);
  for (const auto& pole : poles)
    if (pole.imag() >= 0.0) Raise(system, std::abs(pole), norm);
  for (const auto& pole : poles)
    if (pole.imag() > 0.0) Raise(system, pole.imag(), norm);
  return norm;
}

}  // namespace

HinfNorm NormOf(const StateSpace& given, double tolerance) {
  constexpr int kMostSteps = 60;
  const StateSpace system = Balanced(given);
  const Eigen::VectorXcd poles = Poles(system);
  if (poles.size() > 0 && !(poles.real().maxCoeff() < 0.0))
    throw Problem(ExitStatus::kOther, "an unstable model has no H-infinity norm");
  HinfNorm norm = FirstGuess(system, poles);
  const Eigen::Index p = system.outputs();
  const Eigen::Index m = system.inputs();
  Eigen::MatrixXd pi = Eigen::MatrixXd::Zero(p + m, p + m);
  pi.topLeftCorner(p, p).setIdentity();
  for (int step = 0; step < kMostSteps; ++step) {
    norm.upper = norm.lower * (1.0 + tolerance);
    if (norm.lower == 0.0) return norm;
    pi.bottomRightCorner(m, m).diagonal().setConstant(-norm.upper * norm.upper);
    auto crossings = CrossingFrequencies(system, pi);
    if (!crossings) {  // the level is a singular value of D: cannot be above lower, so rounding
      norm.lower *= 1.0 + 0.5 * tolerance;
      continue;
    }
    if (crossings->empty()) return norm;
    const double before = norm.lower;
    crossings->insert(crossings->begin(), 0.0);
    for (std::size_t i = 0; i + 1 < crossings->size(); ++i)
      Raise(system, 0.5 * ((*crossings)[i] + (*crossings)[i + 1]), norm);
    for (const double crossing : *crossings) Raise(system, crossing, norm);
    // A listed crossing that is none leaves nothing above the level: the level is the bound.
    if (norm.lower <= before * (1.0 + tolerance)) {
      norm.upper = std::max(norm.lower, before) * (1.0 + tolerance);
      return norm;
    }
  }
  return norm;
}

}  // namespace levitas::synthesis
