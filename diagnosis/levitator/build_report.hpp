#pragma once
// The report of a levitator's diagnosis: the same plain data as for a rotor.
//
// Place    that of the first cause in the catalogue of effects.
// Ties     of every named cause: candidates that are less than the decisive evidence, or a share of
//          the cause's, behind it in its place.
// Thread   any; pure.

#include "diagnosis/levitator/levitator_result.hpp"

namespace levitas::levitator {

/// From `found`, `validation` and `fitted` of the result, for the records it was found in.
[[nodiscard]] diagnosis::DiagnosisReport BuildReport(const configuration::RigFile& rig,
                                                     const NominalRig& nominal,
                                                     const std::vector<Series>& data,
                                                     const LevitatorResult& result);

/// Causes, candidates, ties and place alone.
void ReportCauses(const Found& found, diagnosis::DiagnosisReport& report);

}  // namespace levitas::levitator
