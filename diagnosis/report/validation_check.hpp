#pragma once
// Validation: whether the extended model also explains records that were not fitted, for instance
// at another speed or current.
//
// Failed     on separate validation records the extended model leaves a residual of more than
//            kFarAboveNoise times the noise (rms) and kFarAboveNoise times that on the fitted ones.
// Thread     any; pure.

#include <string>

namespace levitas::diagnosis {

struct DiagnosisReport;

inline constexpr double kFarAboveNoise = 1.5;

[[nodiscard]] bool PassesValidation(const DiagnosisReport& report);
/// Sentence for an answer that does not carry over, and whether the forecast's interval had room
/// for that; empty for one that does.
[[nodiscard]] std::string ValidationSentence(const DiagnosisReport& report);
/// The next experiment for an answer that does not carry over.
[[nodiscard]] std::string ValidationExperiment(const DiagnosisReport& report);
/// Whether the rotor turns faster in the validation records than in the fitted ones [rad/s].
[[nodiscard]] bool IsFaster(double validation_rad_per_s, double fitted_rad_per_s);

}  // namespace levitas::diagnosis
