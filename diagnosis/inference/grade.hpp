#pragma once
// The verdict on causes, from their evidence and from what the model with them leaves.
//
// Left      a residual whose worst band lies beyond unexplained_sigma is unexplained while the
//           causes take away less than their share of the calibrated model's excess:
//           explained_share, or nearly_all_share where a line stands out beyond stands_out_sigma.
// Suspected then, a leader that is far ahead of every other effect, unless the causes were cut off
//           as a chain. What is left is of something else: the probability of the leader counts
//           for the share of the excess that is taken away, and must remain above kLikely.
// Unknown   all else that is unexplained.
// Stopped   a search that was stopped has neither ruled out a cause nor proven one.
// Thread    any; pure but for `found`. Units: nat, deviations of chance, shares.

#include "diagnosis/inference/cause_selection.hpp"

namespace levitas::diagnosis {

/// What the model with the causes leaves of the records.
struct Remainder {
  double sigma{};      ///< power of the worst band, in deviations of chance
  double explained{};  ///< share of the calibrated model's excess that the causes took away
};

/// Says in `found.doubt` and `found.probability` why causes are suspected in spite of what is left.
[[nodiscard]] Verdict GradeOf(const SelectionRules& rules, const Remainder& left,
                              CauseSelection& found);

}  // namespace levitas::diagnosis
