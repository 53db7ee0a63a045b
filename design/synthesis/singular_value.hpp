#pragma once
// The largest singular value of a matrix, real or complex: its gain in the worst direction.
//
// Thread  any; pure. Failure: none; zero for a matrix without entries.

#include <Eigen/SVD>

#include "numerics/spectra/spectra.hpp"

namespace levitas::synthesis {

template <class Matrix>
[[nodiscard]] double LargestSingularValue(const Matrix& matrix) {
  using Plain = typename Matrix::PlainObject;
  return matrix.size() == 0 ? 0.0 : Eigen::JacobiSVD<Plain>(matrix).singularValues()(0);
}

}  // namespace levitas::synthesis
