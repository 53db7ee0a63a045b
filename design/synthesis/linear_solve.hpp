#pragma once
// A X = B for matrices that may be empty: a gain is a system without states.
// Thread: any. Failure: none; whether A is regular is asked before.

#include <Eigen/LU>

namespace levitas::synthesis {

/// The solution of A X = B by a factorisation of a square A, also for B without rows or columns:
/// Eigen 3.4 takes the address of the first number of B there, which has none.
template <class Factorisation>
typename Factorisation::MatrixType SolveColumns(
    const Factorisation& factorisation, const typename Factorisation::MatrixType& right_side) {
  if (right_side.size() == 0) return right_side;
  return factorisation.solve(right_side);
}

}  // namespace levitas::synthesis
