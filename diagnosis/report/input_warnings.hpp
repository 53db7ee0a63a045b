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

#include "diagnosis/report/named_values.hpp"

namespace levitas::diagnosis {

inline constexpr double kFarOut = 10.0;     ///< tolerances of the rig file
inline constexpr double kNoMotion = -10.0;  ///< [%] of the ceiling, which is known to a few
inline constexpr double kChanged = 5.0;     ///< tolerances narrowed by healthy records

/// Why units, signs or the rig file are to be doubted; empty where they are not.
[[nodiscard]] std::string DoubtSentence(const DiagnosisResult& answer);
/// Changes by the healthy records, and whether those fit the present rig; empty without them.
[[nodiscard]] std::string HealthySentence(const DiagnosisResult& answer);
/// Calibrated values that are not what the healthy records say, furthest first.
[[nodiscard]] std::vector<CalibratedValue> ChangedSince(const DiagnosisResult& answer);

}  // namespace levitas::diagnosis
