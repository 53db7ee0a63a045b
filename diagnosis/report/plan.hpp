#pragma once
// The scenario that would separate what these data could not: a file for `amb run --scenario`.
//
// Contents   a test signal on every axis in turn when causes in the loop (timing, amplifier,
//            magnet, sensor) are confusable, with the fastest clock when the difference is at high
//            frequency; slow roll, two speeds and a run-up when causes of the rotation are; all of
//            it when the residual has no name.
// Not in it  what a scenario cannot do: another bias current, a weight hung on the shaft, a record
//            of the healthy rig. NextExperiment (report_text.hpp) says when one of those is needed.
// Thread     any; pure.

#include <string>

#include "configuration/rig_file.hpp"
#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::diagnosis {

[[nodiscard]] std::string PlanScenario(const DiagnosisReport& report,
                                       const configuration::RigFile& rig);

}  // namespace levitas::diagnosis
