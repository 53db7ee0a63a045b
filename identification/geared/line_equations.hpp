#pragma once
// Linear least squares from complex equations in real unknowns, each with its standard deviation.
//
// Equation  sum_k a_k x_k = b +- sigma as two real rows; columns scaled to unit length, so that
//           units do not decide what counts as small.
// Errors    from the residual, or from the given sigmas where the residual is smaller than they
//           say; `condition` of the scaled design.
// Failure   BadInput naming the step when the rows do not determine the unknowns. Thread any.

#include <Eigen/Core>
#include <complex>

namespace levitas::identification {

struct Solution {
  Eigen::VectorXd value, sigma;
  double condition{};
  double unexplained{};  ///< norm of the residual over that of the right side
  double sigmas{};       ///< rms of the weighted residual; infinite without weights
};

class LineEquations {
 public:
  LineEquations(std::size_t lines, Eigen::Index unknowns);
  void Real(Eigen::Index unknown, std::complex<double> a);
  /// A complex unknown stands as real and imaginary part.
  void ComplexAt(Eigen::Index unknown, std::complex<double> a);
  void Close(std::complex<double> b, double sigma = 1.0);
  [[nodiscard]] Solution Solve(const char* step) const;

 private:
  Eigen::MatrixXd design_;
  Eigen::VectorXd right_;
  Eigen::Index row_{0};
  bool weighted_{};
};

}  // namespace levitas::identification
