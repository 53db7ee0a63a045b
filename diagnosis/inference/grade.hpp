#pragma once
// The verdict on causes, from their evidence and from what the model with them leaves.
//
// Left      a residual whose worst band lies beyond unexplained_sigma is unexplained while the
//           causes take away less than their share of the calibrated model's excess: explained_share,
//           or nearly_all_share where a line stands out beyond stands_out_sigma.
// Unknown   then, but for a leader that is far ahead of every other effect, and of which the causes
//           were not cut off as a chain: it is suspected.
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
