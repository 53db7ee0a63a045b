#pragma once
// The structure of an uncertainty: a block diagonal of perturbations between outputs and inputs of
// M.
//
// Equation   w = Delta z, z = M w, Delta = diag(Delta_1, ...), each of norm at most 1:
//            full complex: any matrix; repeated complex: delta I; repeated real: delta I, delta
//            real.
// Order      the blocks take the rows and columns of M from first to last and cover all of them.
// Failure    std::invalid_argument when they do not fit. Thread: any; pure.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace levitas::synthesis {

enum class BlockKind { kFullComplex, kRepeatedComplex, kRepeatedReal };

struct UncertaintyBlock {
  BlockKind kind{BlockKind::kFullComplex};
  Eigen::Index rows{1};     ///< of M: the block's inputs z
  Eigen::Index columns{1};  ///< of M: the block's outputs w; equal to `rows` for repeated blocks
};

using UncertaintyBlocks = std::vector<UncertaintyBlock>;

/// visit(index, block, first row of M, first column of M) for every block in order.
template <class Visit>
void ForEachBlock(const UncertaintyBlocks& blocks, const Visit& visit) {
  Eigen::Index row = 0;
  Eigen::Index column = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    visit(i, blocks[i], row, column);
    row += blocks[i].rows;
    column += blocks[i].columns;
  }
}

void CheckBlocks(const UncertaintyBlocks& blocks, Eigen::Index rows, Eigen::Index columns);

/// The same with every repeated block as complex: a larger set, so its bound is a bound too.
[[nodiscard]] UncertaintyBlocks AsComplex(UncertaintyBlocks blocks);

}  // namespace levitas::synthesis
