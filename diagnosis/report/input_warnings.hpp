#pragma once
// Warnings that the input, rather than the rig, may be wrong.
//
// Input      a calibrated value is kFarOut tolerances away from the rig file, or the noise exceeds
//            the motion (ceiling below kNoMotion). Wrong units, signs or a wrong rig file are
//            then more likely than a fault of the rig.
// Healthy    how far the reference (healthy) records moved each parameter, and whether the present
//            estimate is more than kChanged narrowed tolerances away from that: a different rig, or
//            one that has changed since.
// Thread     any; pure.

#include <string>
#include <vector>

#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::diagnosis {

inline constexpr double kFarOut = 10.0;     ///< tolerances of the rig file
inline constexpr double kNoMotion = -10.0;  ///< [%] of the ceiling, which is known to a few
inline constexpr double kChanged = 5.0;     ///< tolerances narrowed by healthy records

/// Why units, signs or the rig file are to be doubted, from the calibrated values and the ceilings
/// of the fits; empty where they are not.
[[nodiscard]] std::string InputWarning(const DiagnosisReport& report);
/// Changes by the healthy records, and whether those fit the present rig.
[[nodiscard]] std::string HealthySentence(const std::vector<CalibratedValue>& calibrated);
/// Calibrated values that are not what the healthy records say, in the given order.
[[nodiscard]] std::vector<CalibratedValue> ChangedSince(
    const std::vector<CalibratedValue>& calibrated);

}  // namespace levitas::diagnosis
