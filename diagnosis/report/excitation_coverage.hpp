#pragma once
// Persistence of excitation: which effects the records can show at all. The verdict `none` holds
// only for these.
//
// Rotation   effects that rotate with the rotor are not observable at rest.
// Test       without a test signal the currents contain little but fed-back noise, and effects of
//            the loop (gains, delays, bandwidths) are hardly observable. A CSV without the column
//            counts as without test signal.
// Thread     any; pure.

#include <string>
#include <vector>

#include "diagnosis/diagnose/diagnose_files.hpp"

namespace levitas::diagnosis {

struct Coverage {
  bool turns{};    ///< faster than a slow roll
  bool excited{};  ///< by a test signal
};

[[nodiscard]] Coverage CoverageOf(const DiagnosisResult& answer);
/// Effects that are not, or hardly, observable.
[[nodiscard]] std::vector<effect::Id> UnobservableEffects(const DiagnosisResult& answer);
/// One sentence naming those effects; empty when there are none.
[[nodiscard]] std::string UnobservableSentence(const DiagnosisResult& answer);
/// The record that would show them; empty when nothing is missing.
[[nodiscard]] std::string MissingRecords(const DiagnosisResult& answer);

}  // namespace levitas::diagnosis
