#pragma once
// A cause that calibration swallowed: fitted together with it, from the rig file on.
//
// Why        a calibration moves whatever follows the records, mode shapes by seven tolerances if
//            need be, into a basin from which a fit of the true cause does not come back: the
//            cause then gains less than it is worth, and a residual is left that nothing explains.
// When       a number of the calibration lies surely beyond `moved_tolerances`.
// Method     the numbers of the rig's build held near the file (NearFile), everything linearised
//            there, and the causes that the screen puts first fitted from there, calibration
//            included, on the whitening of the calibrated model. Evidence counts what calibration
//            pays for its moves; the best set is taken where it is ahead of the calibrated model by
//            `decisive_nat`.
// Cost       two linearisations and up to kTried fits; nothing where calibration stayed near.
// Thread     blocks the caller, two threads inside.

#include "diagnosis/inference/record_landscape.hpp"

namespace levitas::diagnosis {

/// True when `found` begins with a cause now; the landscape is linearised at its theta in any case,
/// as it was before.
[[nodiscard]] bool StartNearFile(RecordLandscape& landscape, const std::vector<Record>& all,
                                 const SelectionRules& rules, CauseSelection& found);

}  // namespace levitas::diagnosis
