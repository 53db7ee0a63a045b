#include "identification/balance/correction.hpp"

#include <cmath>

#include "numerics/factors/factors.hpp"

namespace levitas::balancing {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

/// Of a plane's own square over all speeds.
constexpr double kIdleShare = 1e-6;
/// A circular normal vector's length stays below this many of its deviations with 95 %.
constexpr double kRayleigh95 = 2.4477;

/// A complex matrix as it acts on (real parts, imaginary parts).
MatrixXd RealOf(const MatrixXcd& m) {
  MatrixXd out(2 * m.rows(), 2 * m.cols());
  out << m.real(), -m.imag(), m.imag(), m.real();
  return out;
}

}  // namespace

Correction Correct(const std::vector<SpeedResponse>& responses,
                   const std::vector<Index>& accessible, const MatrixXd& covariance) {
  const Index planes = responses.front().per_unbalance.cols();
  const auto count = static_cast<Index>(accessible.size());
  MatrixXcd chosen = MatrixXcd::Zero(planes, count);
  for (Index i = 0; i < count; ++i) chosen(accessible[static_cast<std::size_t>(i)], i) = 1.0;
  MatrixXcd square = MatrixXcd::Zero(planes, planes);
  VectorXcd seen = VectorXcd::Zero(planes);
  for (const SpeedResponse& at : responses) {
    square += at.per_unbalance.adjoint() * at.per_unbalance;
    seen += at.per_unbalance.adjoint() * at.now_m;
  }
  MatrixXcd normal = chosen.adjoint() * square * chosen;
  normal.diagonal() *= 1.0 + kIdleShare;
  const auto solver = normal.llt();
  Correction made;
  made.added_kg_m = -solver.solve(VectorXcd(chosen.adjoint() * seen));
  const MatrixXd real = RealOf(-solver.solve(MatrixXcd(chosen.adjoint() * square)));
  made.covariance = real * covariance * real.transpose();
  return made;
}

std::vector<OrbitForecast> ForecastOrbits(const std::vector<SpeedResponse>& responses,
                                          const VectorXcd& added_kg_m, const MatrixXd& covariance) {
  std::vector<OrbitForecast> made;
  made.reserve(responses.size());
  for (const SpeedResponse& at : responses) {
    OrbitForecast one{
        at.speed_rad_per_s, Radii(at.now_m), Radii(at.now_m + at.per_unbalance * added_kg_m), {}};
    const MatrixXd real = RealOf(at.per_unbalance);
    const Eigen::VectorXd variance = (real * covariance * real.transpose()).diagonal();
    const Index axes = at.per_unbalance.rows();
    one.after_high_m = one.after_m;
    for (Index b = 0; b < one.after_m.size(); ++b) {
      // A forward circle has the same in x and y; an ellipse is within what both have together.
      const double mean = 0.25 * (variance[2 * b] + variance[2 * b + 1] + variance[axes + 2 * b] +
                                  variance[axes + 2 * b + 1]);
      one.after_high_m[b] += kRayleigh95 * std::sqrt(mean);
    }
    made.push_back(std::move(one));
  }
  return made;
}

}  // namespace levitas::balancing
