#pragma once
// Inner products of all pairs of columns, in double precision: the bulk of a linearisation's sums.
//
// Equation   out(i, k) += sum over n of column(i)[n] column(k)[n], k <= i.
// Cost       4 products per clock cycle with AVX2, half of that without; chosen at start-up. Both
//            ways round alike: no contraction (cmake/Compiler.cmake).
// Thread     any.

#include <Eigen/Core>

namespace levitas::diagnosis {

inline constexpr std::size_t kProductRows = 256;  ///< a few columns stay in the nearest cache

/// `columns` has kProductRows rows and a multiple of four columns; `out` is square of that size,
/// lower triangle (some of the upper one is written as well).
void AddCrossProducts(const Eigen::MatrixXd& columns, Eigen::MatrixXd& out) noexcept;

}  // namespace levitas::diagnosis
