#pragma once
// Evidence of the data for a cause: Laplace's approximation, from normal equations.
//
// Equation   log p(data | base + cause) - log p(data | base) = 1/2 r^T (S+1)^-1 r - 1/2 log
//            det(S+1), where S and r are the cause's normal equations after the base (nuisances
//            with their tolerances, causes already accepted) is projected out. The second part is
//            the Occam factor of the hypothesis (MacKay 1992, Bayesian interpolation). Added are
//            the log prior of its place and, for a cause that cannot be negative, ln 2.
// Origin     parameters are deviations from the nominal rig, not from the linearisation point;
//            their priors are centred there.
// Units      nats. Thread: any; pure.

#include <Eigen/Core>
#include <vector>

#include "diagnosis/inference/hypothesis.hpp"
#include "diagnosis/model/normal_equations.hpp"

namespace levitas::diagnosis {

/// Normal equations as if taken at theta = 0 (units of Term::scale()).
struct LinearProblem {
  Eigen::MatrixXd jtj;
  Eigen::VectorXd jte;
  double ete{};
  std::size_t values{};
};

[[nodiscard]] LinearProblem AtOrigin(const NormalEquations& equations,
                                     const Eigen::VectorXd& theta_scaled);

struct Fit {
  Eigen::VectorXd theta;      ///< all terms, units of Term::scale()
  Eigen::VectorXd deviation;  ///< posterior standard deviation of each term
  double squared_sum{};       ///< predicted e^T e
  double penalty{};           ///< squared sum of parameters over their priors
  double log_evidence{};      ///< relative to all parameters at 0
};

class Evidence {
 public:
  /// `accepted` are causes that belong to the base.
  Evidence(const LinearProblem& problem, const std::vector<Term>& terms,
           const std::vector<Hypothesis>& accepted);

  /// Gain of adding the hypothesis [nats], prior of its place included; -infinity if it would have
  /// to be negative.
  [[nodiscard]] double Gain(const Hypothesis& hypothesis) const { return Weigh(hypothesis).gain(); }
  /// The same in its two parts, both in nats.
  struct Weight {
    double explained{};  ///< by which it lowers half the squared sum with penalties; -infinity
    double occam{};      ///< 1/2 log det (S + 1)
    double prior{};      ///< logarithm of that of its place
    double half{};       ///< ln 2 where it cannot be negative
    [[nodiscard]] double gain() const noexcept { return explained - occam + prior + half; }
    [[nodiscard]] double paid() const noexcept { return occam - prior - half; }
  };
  [[nodiscard]] Weight Weigh(const Hypothesis& hypothesis) const;
  /// The base with the accepted causes.
  [[nodiscard]] Fit Solve() const;
  /// Root of the posterior's covariance: terms x base parameters, units of Term::scale().
  [[nodiscard]] Eigen::MatrixXd Spread() const;
  /// Towards the solution from `theta` (units of Term::scale()), no further than the linearisation
  /// is good for: steps are held back as if by `damping` more priors about theta, which leaves
  /// those that the data determine and shortens those that they do not (Levenberg 1944).
  [[nodiscard]] Eigen::VectorXd Step(const Eigen::VectorXd& theta, double damping) const;
  /// The step of all and of one parameter more, whose slopes are known by their products alone.
  struct Beside {
    double step{};          ///< of the further parameter
    Eigen::VectorXd theta;  ///< where the others go with it
  };
  /// `cross`: slopes of all with its slope, J^T j; `gradient`: e^T j; `curvature`: j^T j. No
  /// further than `most` either way; where the cost bends the wrong way, as far downhill.
  [[nodiscard]] Beside StepBeside(const Eigen::VectorXd& theta, const Eigen::VectorXd& cross,
                                  double gradient, double curvature, double most) const;

  /// What other data make of the solution, for which it is the prior, with all that these data
  /// leave undetermined.
  struct Adapted {
    Eigen::VectorXd parameters;  ///< of the base, from the solution
    Eigen::VectorXd change;      ///< of theta, from the solution; units of Term::scale()
    double penalty{};            ///< squared sum of the parameters over their prior
  };
  /// A Gauss-Newton step from `so_far`, where `there` are the other data's normal equations;
  /// `damping` is what the diagonal grows by (Marquardt 1963, J. SIAM 11(2), 431).
  [[nodiscard]] Adapted Adapt(const NormalEquations& there, const Adapted& so_far,
                              double damping = 0.0) const;
  /// No change.
  [[nodiscard]] Adapted Unchanged() const;

 private:
  /// Gradient of half the cost by the parameters of the base.
  [[nodiscard]] Eigen::VectorXd Uphill(const Eigen::VectorXd& theta) const;

  const LinearProblem& problem_;
  Eigen::MatrixXd base_;      ///< terms x base parameters, scaled by their priors
  Eigen::MatrixXd jtj_base_;  ///< terms x base parameters
  Eigen::MatrixXd factor_;    ///< lower Cholesky factor of base normal equations + 1
  Eigen::VectorXd solution_;
  double log_determinant_{};
};

}  // namespace levitas::diagnosis
