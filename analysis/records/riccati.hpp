#pragma once
// Stationary covariance of a Kalman filter: the filter's discrete Riccati equation.
//
// Equation   P = A P A' - A P C' (C P C' + R)^-1 C P A' + Q
// Method     structure-preserving doubling (Chu, Fan, Lin & Wang, Int. J. Control 77, 2004):
//            squares the closed-loop transition each step, so a dozen steps reach the stationary
//            state of thousands of samples; needs no eigenvalues.
// Needs      (A, C) detectable, (A, Q) stabilisable, R positive definite. Scale the states so that
//            their variances are of like size: units of metres and newtons mixed lose digits.
// Failure    Problem when the doubling does not settle. Thread: any; pure.

#include <Eigen/Core>
#include <vector>

namespace levitas::analysis {

[[nodiscard]] Eigen::MatrixXd StationaryCovariance(const Eigen::MatrixXd& a,
                                                   const Eigen::MatrixXd& c,
                                                   const Eigen::MatrixXd& q,
                                                   const Eigen::MatrixXd& r);

/// The covariance on its way there, by the same doubling.
class CovarianceSteps {
 public:
  /// Up to 2^most samples at once. Arguments as of StationaryCovariance.
  CovarianceSteps(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c, const Eigen::MatrixXd& q,
                  const Eigen::MatrixXd& r, std::size_t most);

  /// 2^power samples after it was p. std::out_of_range beyond `most`.
  [[nodiscard]] Eigen::MatrixXd After(const Eigen::MatrixXd& p, std::size_t power) const;

 private:
  /// P -> covariance + transition' P (1 + information P)^-1 transition
  struct Step {
    Eigen::MatrixXd transition, information, covariance;
  };
  std::vector<Step> steps_;
};

/// Left minus right side of the equation.
[[nodiscard]] Eigen::MatrixXd RiccatiResidual(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                                              const Eigen::MatrixXd& q, const Eigen::MatrixXd& r,
                                              const Eigen::MatrixXd& p);

}  // namespace levitas::analysis
