#pragma once
// An answer in words; its numbers are in named_values.hpp.
//
// Thread      any; pure.

#include <string>
#include <vector>

#include "diagnosis/report/diagnose_files.hpp"
#include "diagnosis/report/named_values.hpp"

namespace levitas::diagnosis {

[[nodiscard]] std::string VerdictSentence(const DiagnosisResult& answer);
[[nodiscard]] std::string NextExperiment(const DiagnosisResult& answer);
/// Something is left open that a further record would decide.
[[nodiscard]] bool NeedsExperiment(const DiagnosisResult& answer);
/// Probability that the verdict is right: of a cause, among all candidates and none of them; of
/// `none`, against the strongest candidate; 0 for `unknown`, which no effect explains.
[[nodiscard]] double Confidence(const DiagnosisResult& answer);
/// "magnet", "sensor" ...; that of the worst channel's excess for an unknown.
[[nodiscard]] std::string PlaceOf(const DiagnosisResult& answer);
[[nodiscard]] std::string PlaceOfEffect(const std::string& effect);
[[nodiscard]] std::vector<std::string> Channels(const DiagnosisResult& answer);

}  // namespace levitas::diagnosis
