#pragma once
// Whether an answer holds on records that were not fitted: what one does not carry over to another
// speed or current, it has not understood.
//
// Failed     the extended model leaves more than kFarAboveNoise times the noise (rms) on held-out
//            records of their own, and as many times more than on those that were fitted.
// Thread     any; pure.

#include <string>

namespace levitas::diagnosis {

struct SessionAnswer;

inline constexpr double kFarAboveNoise = 1.5;

[[nodiscard]] bool CarriesOver(const SessionAnswer& answer);
/// What to tell of an answer that does not; empty where it does.
[[nodiscard]] std::string CarryOverSentence(const SessionAnswer& answer);
/// What to record or fit then.
[[nodiscard]] std::string CarryOverExperiment(const SessionAnswer& answer);
/// Whether the held-out records turn faster than what was fitted.
[[nodiscard]] bool HeldOutIsFaster(const SessionAnswer& answer);

}  // namespace levitas::diagnosis
