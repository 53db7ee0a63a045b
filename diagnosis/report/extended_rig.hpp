#pragma once
// The rig file with the causes switched on.
//
// Form       the nominal rig's complete text and the list `effects:` of docs/effects.md, one entry
//            per place, parameters at their estimates. What a cause has beyond the vocabulary's
//            parameters (lost frames' times, a line's phase of every record) is left out.
// Check      read back by the strict reader, so that `amb run` accepts it; where this build's
//            reader refuses an entry, it stays in the file as a comment that says so.
// Thread     any.

#include <string>
#include <vector>

#include "diagnosis/diagnose/diagnose_files.hpp"

namespace levitas::diagnosis {

/// One entry per place of a cause.
[[nodiscard]] std::vector<effect::EffectConfig> EffectEntries(const DiagnosisResult& answer);
/// What a cause changes under a key of the file's own: a delay shorter than the file says.
[[nodiscard]] configuration::RigFile WithOwnKeys(const DiagnosisResult& answer,
                                                 configuration::RigFile rig);
/// The rig's complete text with these entries behind its own, or in the place of its own where they
/// were counted (lost frames, noise); what its reader refuses as comments.
[[nodiscard]] std::string WithEffects(configuration::RigFile rig,
                                      const std::vector<effect::EffectConfig>& entries);
[[nodiscard]] std::string ExtendedRig(const DiagnosisResult& answer,
                                      const configuration::RigFile& rig);

}  // namespace levitas::diagnosis
