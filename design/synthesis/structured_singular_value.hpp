#pragma once
// The structured singular value mu of a matrix: 1/mu is the size of the smallest perturbation of
// the given structure that makes I - M Delta singular.
//
// Upper      least sqrt(b) with M* D M + j (G M - M* G) <= b D, D > 0 Hermitian and G Hermitian
//            (for real blocks only), both commuting with the structure: M. K. H. Fan, A. L. Tits,
//            J. C. Doyle, IEEE Trans. Automatic Control 36 (1991) 25. Solved as a generalised
//            eigenvalue problem by the method of centres (S. Boyd, L. El Ghaoui, Linear Algebra
//            Appl. 188 (1993) 63), Newton's method at each centre.
// Lower      power iteration of P. M. Young, J. C. Doyle (Conf. Decision and Control 1990, 1230)
//            from several starts; the perturbation that it finds is evaluated by its eigenvalues,
//            so the bound holds whether the iteration settled or not. Beside complex blocks, real
//            ones are also held at corners and drawn places. Weak for real blocks alone.
// Thread     any; pure: restarts have a fixed seed.
// Failure    std::invalid_argument for a structure that does not fit.

#include <Eigen/Core>

#include "design/synthesis/uncertainty_blocks.hpp"

namespace levitas::synthesis {

/// Scalings that prove an upper bound; `rows` acts on z, `columns` on w, `G` is columns x rows.
struct MuScaling {
  Eigen::MatrixXcd rows, columns, G;
};

struct MuUpper {
  double value{};
  MuScaling scaling;
};

/// `real_scaling`: D real symmetric and G zero, for what must be realised or tested in real
/// arithmetic; the bound is that of complex blocks, and a little above for repeated ones.
[[nodiscard]] MuUpper MuUpperBound(const Eigen::MatrixXcd& M, const UncertaintyBlocks& blocks,
                                   bool real_scaling = false);

[[nodiscard]] double MuLowerBound(const Eigen::MatrixXcd& M, const UncertaintyBlocks& blocks);

}  // namespace levitas::synthesis
