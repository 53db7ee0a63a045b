#pragma once
// A row over the modes times their coordinates: displacement, twist or velocity at one place.
//
// Thread  any; pure, no allocation.

#include <cstddef>
#include <vector>

namespace levitas::plant {

/// `modal` has at least as many numbers as the row.
[[nodiscard]] inline double ModalSum(const std::vector<double>& row, const double* modal) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < row.size(); ++i) sum += row[i] * modal[i];
  return sum;
}

}  // namespace levitas::plant
