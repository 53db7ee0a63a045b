#include "diagnosis/inference/evidence.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/factors/factors.hpp"

namespace levitas::diagnosis {

LinearProblem AtOrigin(const NormalEquations& equations, const Eigen::VectorXd& theta_scaled) {
  LinearProblem p;
  p.jtj = equations.jtj;
  p.jte = equations.jte - equations.jtj * theta_scaled;
  p.ete = equations.ete - 2.0 * theta_scaled.dot(equations.jte) +
          theta_scaled.dot(equations.jtj * theta_scaled);
  p.values = equations.values;
  return p;
}

Evidence::Evidence(const LinearProblem& problem, const std::vector<Term>& terms,
                   const std::vector<Hypothesis>& accepted)
    : problem_(problem) {
  const auto all = static_cast<Eigen::Index>(terms.size());
  Eigen::Index columns = 0;
  for (const Term& term : terms) columns += term.nuisance() ? 1 : 0;
  for (const Hypothesis& h : accepted) columns += h.directions.cols();
  base_ = Eigen::MatrixXd::Zero(all, columns);
  Eigen::Index at = 0;
  for (Eigen::Index i = 0; i < all; ++i) {
    const Term& term = terms[static_cast<std::size_t>(i)];
    if (term.nuisance()) base_(i, at++) = term.tolerance / term.scale();
  }
  for (const Hypothesis& h : accepted) {
    base_.middleCols(at, h.directions.cols()) = h.directions;
    at += h.directions.cols();
  }
  jtj_base_ = problem.jtj * base_;
  Eigen::MatrixXd normal = base_.transpose() * jtj_base_;
  normal.diagonal().array() += 1.0;
  const Eigen::LLT<Eigen::MatrixXd> llt(normal);
  factor_ = llt.matrixL();
  solution_ = llt.solve(-base_.transpose() * problem.jte);
  log_determinant_ = 2.0 * factor_.diagonal().array().log().sum();
}

Evidence::Weight Evidence::Weigh(const Hypothesis& h) const {
  const Eigen::MatrixXd cross =
      factor_.triangularView<Eigen::Lower>().solve(jtj_base_.transpose() * h.directions);
  Eigen::MatrixXd s =
      h.directions.transpose() * problem_.jtj * h.directions - cross.transpose() * cross;
  s.diagonal().array() += 1.0;
  const Eigen::VectorXd r = -h.directions.transpose() * (problem_.jte + jtj_base_ * solution_);
  const Eigen::LLT<Eigen::MatrixXd> llt(s);
  const Eigen::VectorXd u = llt.solve(r);
  const Eigen::MatrixXd l = llt.matrixL();
  // A cause that cannot be negative has half the prior volume.
  const double half = h.positive ? std::log(2.0) : 0.0;
  const bool refused = h.positive && u.minCoeff() < 0.0;
  return {refused ? -std::numeric_limits<double>::infinity() : 0.5 * r.dot(u),
          l.diagonal().array().log().sum(), h.log_prior, half};
}

Eigen::MatrixXd Evidence::Spread() const {
  return factor_.triangularView<Eigen::Lower>().solve(base_.transpose()).transpose();
}

Fit Evidence::Solve() const {
  Fit fit;
  fit.theta = base_ * solution_;
  fit.deviation = Spread().rowwise().norm();
  fit.penalty = solution_.squaredNorm();
  fit.squared_sum =
      problem_.ete + 2.0 * fit.theta.dot(problem_.jte) + fit.theta.dot(problem_.jtj * fit.theta);
  fit.log_evidence = 0.5 * (problem_.ete - fit.squared_sum - fit.penalty) - 0.5 * log_determinant_;
  return fit;
}

Eigen::VectorXd Evidence::Uphill(const Eigen::VectorXd& theta) const {
  // Parameters of the base behind theta: those of the smallest penalty.
  constexpr double kJitter = 1e-9;
  Eigen::MatrixXd covariance = base_ * base_.transpose();
  covariance.diagonal().array() += kJitter;
  return base_.transpose() * (problem_.jte + problem_.jtj * theta + covariance.llt().solve(theta));
}

Eigen::VectorXd Evidence::Step(const Eigen::VectorXd& theta, double damping) const {
  Eigen::MatrixXd normal = base_.transpose() * jtj_base_;
  normal.diagonal().array() += 1.0 + damping;
  return theta - base_ * normal.llt().solve(Uphill(theta));
}

Evidence::Beside Evidence::StepBeside(const Eigen::VectorXd& theta, const Eigen::VectorXd& cross,
                                      double gradient, double curvature, double most) const {
  const auto solve = [this](const Eigen::VectorXd& right) -> Eigen::VectorXd {
    const auto lower = factor_.triangularView<Eigen::Lower>();
    return lower.transpose().solve(lower.solve(right));
  };
  const Eigen::VectorXd uphill = Uphill(theta);
  const Eigen::VectorXd along = base_.transpose() * cross;
  const Eigen::VectorXd answer = solve(along);
  // Parts of both that are orthogonal to the other parameters (Schur complement).
  const double slope = gradient - answer.dot(uphill);
  const double bend = curvature - answer.dot(along);
  Beside beside;
  beside.step = bend > 0.0 ? std::clamp(-slope / bend, -most, most) : (slope > 0.0 ? -most : most);
  beside.theta = theta - base_ * (solve(uphill) + answer * beside.step);
  return beside;
}

Evidence::Adapted Evidence::Unchanged() const {
  return {Eigen::VectorXd::Zero(base_.cols()), Eigen::VectorXd::Zero(base_.rows()), 0.0};
}

Evidence::Adapted Evidence::Adapt(const NormalEquations& there, const Adapted& so_far,
                                  double damping) const {
  const Eigen::MatrixXd prior = factor_ * factor_.transpose();
  Eigen::MatrixXd both = prior + base_.transpose() * there.jtj * base_;
  both.diagonal() *= 1.0 + damping;
  const Eigen::VectorXd uphill = base_.transpose() * there.jte + prior * so_far.parameters;
  const Eigen::VectorXd parameters = so_far.parameters - both.llt().solve(uphill);
  return {parameters, base_ * parameters, (factor_.transpose() * parameters).squaredNorm()};
}

}  // namespace levitas::diagnosis
