#pragma once
// The rig file as it was judged: with the calibrated values and the causes in it.
//
// Where    the delay and the unbalance in their own keys; all else as entries of the list
//          `effects`, the causes first. Shapes of the modes have no key: they stand in comments.
// Rigs     with geared shafts: the stiffness and damping of the shafts have none either.
// Check    read back by the strict reader; entries it refuses become comments.
// Thread   any.

#include <string>
#include <vector>

#include "diagnosis/diagnose/diagnose_files.hpp"

namespace levitas::diagnosis {

/// Entries of `effects` for calibrated values that have no key of their own.
[[nodiscard]] std::vector<effect::EffectConfig> CalibratedEntries(const DiagnosisResult& answer);
[[nodiscard]] std::string CalibratedRig(const DiagnosisResult& answer,
                                        const configuration::RigFile& rig);

}  // namespace levitas::diagnosis
