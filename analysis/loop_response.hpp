#pragma once
// Frequency response of a sampled loop: the sensitivity matrix S = (I + P C)^-1.
//
// Cost      one solve of a Hessenberg system per frequency, O(states^2): the plant's matrix is
//           brought to Hessenberg form once.
// Thread    one instance per thread.

#include <Eigen/Core>
#include <complex>

#include "analysis/sampled_loop.hpp"

namespace levitas::analysis {

class LoopResponse {
 public:
  explicit LoopResponse(const SampledLoop& loop);

  /// P(e^{j 2 pi f T}) [m/A].
  [[nodiscard]] Eigen::MatrixXcd Plant(double frequency_hz) const;
  [[nodiscard]] Eigen::MatrixXcd Sensitivity(double frequency_hz) const;
  [[nodiscard]] double nyquist_hz() const noexcept { return 0.5 / loop_.period_s; }
  [[nodiscard]] std::size_t axes() const noexcept {
    return static_cast<std::size_t>(loop_.plant.c.rows());
  }

 private:
  [[nodiscard]] std::complex<double> Point(double frequency_hz) const;

  SampledLoop loop_;
  Eigen::MatrixXd hessenberg_;
  Eigen::MatrixXcd input_;   ///< Q^T B
  Eigen::MatrixXcd output_;  ///< C Q
};

/// Largest singular value of a matrix.
[[nodiscard]] double LargestSingularValue(const Eigen::MatrixXcd& matrix);

}  // namespace levitas::analysis
