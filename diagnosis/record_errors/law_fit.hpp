#pragma once
// How each column of currents follows from the columns of positions and test signals: the
// controller's own law, fitted to a record. What is wrong with a rig changes what the currents do
// to the positions; this side of the loop is computed, and stays exact whatever the rig does.
//
// Equation   i_c(n) = sum_k a_k i_c(n-k) + sum_k b_k y_p(n-s-k) + sum_k g_k e_j(n-t-k) + const, by
//            least squares, for every column c of currents with one column p of positions and one
//            column j of test signals (none where none is recorded).
// Left       rms of what is left over the rms of i_c; a decentralised law leaves parts in a
//            thousand with its own columns and most of i_c with others. A law between axes leaves
//            much with each: then nothing is known here.
// First      s: the last start of the b_k with which as little is left: by how many rows the
//            currents are behind the positions, 0 for a law that answers a sample at once. t: the
//            same of the test signal. direct, test: the b and g that belong to them.
// Rows       without those whose window crosses a missing or repeated frame, or has a current at
//            the rig's limit.
// Thread     any; pure.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/record_errors/columns.hpp"

namespace levitas::diagnosis {

inline constexpr int kMostShift = 6;       ///< rows by which a column may be early or late
inline constexpr double kLawKnown = 0.05;  ///< left, at most, by a law that is known

struct LawOfColumn {
  bool known{};
  std::size_t position{};  ///< p with which least is left
  double left{1.0};
  double left_own{1.0};     ///< with the position of its own axis
  double left_second{1.0};  ///< with the second best p
  int shift{};              ///< s
  double direct_a_per_m{};
  std::optional<std::size_t> test;  ///< j that explains most, where one is recorded and does
  int test_shift{};
  double test_factor{};
};

/// Per column of currents.
[[nodiscard]] std::vector<LawOfColumn> FitLaw(const RigView& rig, const Columns& columns);

}  // namespace levitas::diagnosis
