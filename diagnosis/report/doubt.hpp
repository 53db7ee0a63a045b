#pragma once
// When an answer says more about the input than about the rig: what to doubt first.
//
// Input      a calibrated value kFarOut tolerances of the rig file away, or a noise that is larger
//            than the motion (ceiling below kNoMotion): units, signs or the rig file are wrong
//            sooner than the rig.
// Healthy    what the records called healthy have moved, and whether what is diagnosed now lies
//            kChanged of the tolerances that they leave away from them: another rig, or one that
//            has changed since.
// Thread     any; pure.

#include <string>
#include <vector>

#include "diagnosis/report/named_values.hpp"

namespace levitas::diagnosis {

inline constexpr double kFarOut = 10.0;     ///< tolerances of the rig file
inline constexpr double kNoMotion = -10.0;  ///< [%] of the ceiling, which is known to a few
inline constexpr double kChanged = 5.0;     ///< tolerances narrowed by healthy records

/// Why units, signs or the rig file are to be doubted; empty where they are not.
[[nodiscard]] std::string DoubtSentence(const SessionAnswer& answer);
/// What the healthy records moved, and whether they are of this rig as it is; empty without them.
[[nodiscard]] std::string HealthySentence(const SessionAnswer& answer);
/// Calibrated values that are not what the healthy records say, furthest first.
[[nodiscard]] std::vector<CalibratedValue> ChangedSince(const SessionAnswer& answer);

}  // namespace levitas::diagnosis
