#pragma once
// An answer in words and in the parameters of a rig file.
//
// Parameters  cosine and sine become amplitude and phase, sqrt(tau) becomes tau, ratios are told as
//             the factor on the nominal value; intervals are 5 to 95 %.
// Thread      any; pure.

#include <string>
#include <vector>

#include "diagnosis/session.hpp"

namespace levitas::diagnosis {

struct NamedParameter {
  std::string effect, name, unit;
  double value{}, low{}, high{};
};

[[nodiscard]] std::vector<NamedParameter> Parameters(const SessionAnswer& answer);
[[nodiscard]] std::string VerdictSentence(const SessionAnswer& answer);
[[nodiscard]] std::string NextExperiment(const SessionAnswer& answer);
/// Probability of the first cause among all candidates and none of them.
[[nodiscard]] double Confidence(const SessionAnswer& answer);
/// "magnet", "sensor" ...; that of the worst channel's excess for an unknown.
[[nodiscard]] std::string PlaceOf(const SessionAnswer& answer);
[[nodiscard]] std::string PlaceOfEffect(const std::string& effect);
[[nodiscard]] std::vector<std::string> Channels(const SessionAnswer& answer);

}  // namespace levitas::diagnosis
