#pragma once
// Residual, verdict and fits of a levitator's diagnosis as parts of its report.
//
// Verdict    `none` without causes; `unknown` when the residual stands well above the noise and the
//            causes have not explained most of the calibrated model's; else `effect`.
// Fits       of the upper coil's current where it was measured, else of the ball's motion; the
//            mean over the records.
// Thread     any.

#include <string>
#include <vector>

#include "diagnosis/levitator/levitator_result.hpp"

namespace levitas::levitator {

/// Adds the residual, its spectra and the verdict; needs the report's causes and `rig_channels`.
void AddResidual(const NominalRig& rig, const std::vector<Series>& data, const Found& found,
                 diagnosis::DiagnosisReport& report);
/// `probes`: the coils' currents were measured.
[[nodiscard]] diagnosis::ReportFit MeanFit(const std::vector<ValidationRun>& runs, bool probes,
                                           const std::string& channel);
[[nodiscard]] std::vector<diagnosis::ReportRun> ReportRuns(const std::vector<ValidationRun>& runs);

}  // namespace levitas::levitator
