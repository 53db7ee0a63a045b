#include "identification/geared/line_equations.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/problem.hpp"
#include "numerics/spectra/spectra.hpp"

namespace levitas::identification {

using Complex = std::complex<double>;
using Index = Eigen::Index;

LineEquations::LineEquations(std::size_t lines, Index unknowns)
    : design_(Eigen::MatrixXd::Zero(2 * static_cast<Index>(lines), unknowns)),
      right_(Eigen::VectorXd::Zero(2 * static_cast<Index>(lines))) {}

void LineEquations::Real(Index unknown, Complex a) {
  design_(row_, unknown) += a.real();
  design_(row_ + 1, unknown) += a.imag();
}

void LineEquations::ComplexAt(Index unknown, Complex a) {
  Real(unknown, a);
  Real(unknown + 1, Complex(0.0, 1.0) * a);
}

void LineEquations::Close(Complex b, double sigma) {
  right_[row_] = b.real() / sigma;
  right_[row_ + 1] = b.imag() / sigma;
  design_.middleRows(row_, 2) /= sigma;
  weighted_ = weighted_ || sigma != 1.0;
  row_ += 2;
}

Solution LineEquations::Solve(const char* step) const {
  const Index rows = design_.rows();
  const Index columns = design_.cols();
  const Eigen::VectorXd length = design_.colwise().norm().cwiseMax(1e-300);
  const Eigen::MatrixXd scaled = design_ * length.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& s = svd.singularValues();
  if (rows < columns || s[s.size() - 1] < 1e-10 * s[0]) {
    throw BadInput(fmt::format(
        "full spectrum: the lines do not determine {} ({} equations, {} unknowns); record more "
        "speeds or more lines",
        step, rows, columns));
  }
  const Eigen::VectorXd value = svd.solve(right_);
  const double freedom = std::max<double>(1.0, static_cast<double>(rows - columns));
  const double residual = std::sqrt((scaled * value - right_).squaredNorm() / freedom);
  const double noise = weighted_ ? std::max(1.0, residual) : residual;
  const Eigen::VectorXd spread =
      (svd.matrixV() * s.cwiseInverse().asDiagonal()).rowwise().norm() * noise;
  return {value.cwiseQuotient(length), spread.cwiseQuotient(length), s[0] / s[s.size() - 1],
          (scaled * value - right_).norm() / std::max(right_.norm(), 1e-300),
          weighted_ ? residual : std::numeric_limits<double>::infinity()};
}

}  // namespace levitas::identification
