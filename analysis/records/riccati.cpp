#include "analysis/records/riccati.hpp"

#include <Eigen/Dense>

#include "common/problem.hpp"
#include "numerics/factors/factors.hpp"

namespace levitas::analysis {
namespace {

/// What a number of samples does to a covariance:
/// P -> covariance + transition' P (1 + information P)^-1 transition
struct Doubling {
  Eigen::MatrixXd transition, information, covariance;

  /// Of one sample. The filter's equation is the regulator's of the transposed system.
  Doubling(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c, const Eigen::MatrixXd& q,
           const Eigen::MatrixXd& r)
      : transition(a.transpose()), information(c.transpose() * r.llt().solve(c)), covariance(q) {}

  /// Of twice as many. Returns what the covariance grew by.
  Eigen::MatrixXd Double() {
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(transition.rows(), transition.cols());
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(one + information * covariance);
    const Eigen::MatrixXd half = lu.solve(transition);
    Eigen::MatrixXd added = transition.transpose() * covariance * half;
    information += transition * lu.solve(information) * transition.transpose();
    transition = (transition * half).eval();
    covariance += 0.5 * (added + added.transpose());
    information = (0.5 * (information + information.transpose())).eval();
    return added;
  }
};

}  // namespace

Eigen::MatrixXd StationaryCovariance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                                     const Eigen::MatrixXd& q, const Eigen::MatrixXd& r) {
  constexpr int kMostSteps = 60;
  constexpr double kSettled = 1e-13;
  Doubling samples(a, c, q, r);
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::MatrixXd added = samples.Double();
    const Eigen::MatrixXd& covariance = samples.covariance;
    if (!covariance.allFinite()) break;
    if (added.lpNorm<Eigen::Infinity>() <= kSettled * covariance.lpNorm<Eigen::Infinity>())
      return covariance;
  }
  throw Problem(ExitStatus::kOther,
                "the observer's Riccati equation does not settle: the linear model has states "
                "that its sensors cannot see, or a sensor without noise");
}

CovarianceSteps::CovarianceSteps(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                                 const Eigen::MatrixXd& q, const Eigen::MatrixXd& r,
                                 std::size_t most) {
  Doubling samples(a, c, q, r);
  steps_.push_back({samples.transition, samples.information, samples.covariance});
  for (std::size_t power = 1; power <= most; ++power) {
    samples.Double();
    steps_.push_back({samples.transition, samples.information, samples.covariance});
  }
}

Eigen::MatrixXd CovarianceSteps::After(const Eigen::MatrixXd& p, std::size_t power) const {
  const Step& step = steps_.at(power);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(p.rows(), p.cols());
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(one + step.information * p);
  const Eigen::MatrixXd grown = step.transition.transpose() * p * lu.solve(step.transition);
  return step.covariance + 0.5 * (grown + grown.transpose());
}

Eigen::MatrixXd RiccatiResidual(const Eigen::MatrixXd& a, const Eigen::MatrixXd& c,
                                const Eigen::MatrixXd& q, const Eigen::MatrixXd& r,
                                const Eigen::MatrixXd& p) {
  const Eigen::MatrixXd s = c * p * c.transpose() + r;
  const Eigen::MatrixXd cross = a * p * c.transpose();
  return p - (a * p * a.transpose() - cross * s.llt().solve(cross.transpose()) + q);
}

}  // namespace levitas::analysis
