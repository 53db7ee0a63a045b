#pragma once
// Between the containers of the standard library and the matrices of the linear algebra, whose
// indices are signed.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace levitas::plant {

/// The index of a matrix for a size or a position in a container; no check, it is never negative.
[[nodiscard]] inline Eigen::Index At(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// The entries of a row, in their order.
[[nodiscard]] inline std::vector<double> ToVector(const Eigen::RowVectorXd& row) {
  return {row.data(), row.data() + row.size()};
}

}  // namespace levitas::plant
