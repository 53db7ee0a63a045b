#include "analysis/riccati.hpp"

#include <Eigen/Dense>

#include "common/problem.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::analysis {

Eigen::MatrixXd StationaryCovariance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                                     const Eigen::MatrixXd& q, const Eigen::MatrixXd& r) {
  constexpr int kMostSteps = 60;
  constexpr double kSettled = 1e-13;
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(a.rows(), a.cols());
  // The filter's equation is the regulator's of the transposed system.
  Eigen::MatrixXd transition = a.transpose();
  Eigen::MatrixXd information = c.transpose() * r.llt().solve(c);
  Eigen::MatrixXd covariance = q;
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(one + information * covariance);
    const Eigen::MatrixXd half = lu.solve(transition);
    const Eigen::MatrixXd added = transition.transpose() * covariance * half;
    information += transition * lu.solve(information) * transition.transpose();
    transition = (transition * half).eval();
    covariance += 0.5 * (added + added.transpose());
    information = (0.5 * (information + information.transpose())).eval();
    if (!covariance.allFinite()) break;
    if (added.lpNorm<Eigen::Infinity>() <= kSettled * covariance.lpNorm<Eigen::Infinity>())
      return covariance;
  }
  throw Problem(ExitStatus::kOther,
                "the observer's Riccati equation does not settle: the linear model has states "
                "that its sensors cannot see, or a sensor without noise");
}

Eigen::MatrixXd RiccatiResidual(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                                const Eigen::MatrixXd& q, const Eigen::MatrixXd& r,
                                const Eigen::MatrixXd& p) {
  const Eigen::MatrixXd s = c * p * c.transpose() + r;
  const Eigen::MatrixXd cross = a * p * c.transpose();
  return p - (a * p * a.transpose() - cross * s.llt().solve(cross.transpose()) + q);
}

}  // namespace levitas::analysis
