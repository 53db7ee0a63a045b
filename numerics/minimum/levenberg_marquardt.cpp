#include "numerics/minimum/levenberg_marquardt.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "numerics/dense/factorisations.hpp"

namespace levitas::numerics {

Eigen::VectorXd DampedStep(const NormalEquations& equations, double damping) {
  Eigen::MatrixXd damped = equations.matrix;
  damped.diagonal() *= 1.0 + damping;
  return damped.ldlt().solve(-equations.gradient);
}

double PredictedGain(const NormalEquations& equations) {
  return equations.gradient.dot(equations.matrix.ldlt().solve(equations.gradient));
}

void Damping::Accept() noexcept {
  value_ = std::max(options_.least_damping, options_.lowered_by * value_);
  refused_ = 0;
}

void Damping::Refuse() noexcept {
  value_ = std::max(options_.least_raised, options_.raised_by * value_);
  ++refused_;
}

bool Damping::MayStep() const noexcept {
  return value_ < options_.most_damping && refused_ < options_.most_refused;
}

}  // namespace levitas::numerics
