#pragma once
// Whether the rig files that a diagnosis writes levitate under the laws of its records.
//
// Method     closed-loop poles (analysis/poles.hpp) of the file as it is written and read back, at
//            kLevitationSpeeds speeds from the slowest to the fastest of a law's records.
// Laws       each at the speeds of its own records. Where neither record nor rig file names one,
//            that is what is said.
// Said       in sentences of the report and as comments at the head of the file concerned. A file
//            that levitates has neither.
// Left out   what the file has no key for (mode shapes); what no linear loop knows (contact, the
//            end of the magnets' force); blocks of synchronous control.
// Cost       some 10 ms per law, speed and file. Thread: any.
// Failure    none: a loop that cannot be computed is said not to be judged, with the reason.

#include "configuration/rig_file.hpp"
#include "diagnosis/diagnose/known_laws.hpp"
#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::diagnosis {

inline constexpr std::size_t kLevitationSpeeds = 9;

/// Judges `report.extended_rig` and `report.calibrated_rig`, texts of rig files made from `rig`,
/// and writes `report.levitation` and the comments.
void JudgeLevitation(const configuration::RigFile& rig, const KnownLaws& known,
                     DiagnosisReport& report);

}  // namespace levitas::diagnosis
