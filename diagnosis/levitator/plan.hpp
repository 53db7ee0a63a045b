#pragma once
// What separates causes that records of a ball between two magnets cannot, in words and as a
// scenario for `amb run --scenario`.
//
// Contents   the ball led slowly over its stroke, a test signal on the current meanwhile: what goes
//            by the gap parts from what does not, and the duty runs from little to much; the ball
//            shaken faster and faster: a load that only adds parts from what scales a force; a test
//            signal of a bit per period: delays and lags part from each other. As much of it as the
//            causes need, all of it when the residual has no name.
// Not in it  pairs that no record of the rig separates: a mass and a force constant (weigh the
//            ball), the gain of a probe and its current (an ammeter). The text says so.
// Size       leading takes two fifths of the touchdown clearance, shaking a seventh; the test
//            signal is cut back where the ball goes further than four fifths.
// Thread     any; pure.

#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::levitator {

/// The experiment that separates the named causes from their ties; empty when
/// nothing is left to separate.
[[nodiscard]] std::vector<std::string> Separations(const diagnosis::DiagnosisReport& report);

/// Empty when no scenario would help.
[[nodiscard]] std::string PlanScenario(const configuration::RigFile& rig,
                                       const diagnosis::DiagnosisReport& report);

}  // namespace levitas::levitator
