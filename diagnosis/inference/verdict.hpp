#pragma once
// The four answers of a diagnosis, and why a cause is suspected instead of named.
//
// Thread  plain data.

namespace levitas::diagnosis {

enum class Verdict {
  kNone,       ///< the calibrated rig explains the records
  kEffect,     ///< causes are decisive
  kSuspected,  ///< a cause is more likely than not, for the reason of `Doubt`
  kUnknown     ///< a residual is left, and no cause is likely
};

/// As `diagnosis.json` has it.
[[nodiscard]] constexpr const char* Word(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::kEffect:
      return "effect";
    case Verdict::kSuspected:
      return "suspected";
    case Verdict::kUnknown:
      return "unknown";
    case Verdict::kNone:
      break;
  }
  return "none";
}

enum class Doubt {
  kNothing,
  kWeakEvidence,    ///< more likely than none, but not decisive
  kMovedNumber,     ///< a calibrated number is outside its tolerance by more than chance
  kUnconfirmed,     ///< decisive there, and the user's validation data leave it open
  kValidationHarm,  ///< decisive on the fitted records, refuted by the user's validation data
  kCutOff,          ///< as many causes as a search may have, and a further one would gain
  kStopped,         ///< found before the search was stopped: not everything was tried against it
  kResidualIsLeft,  ///< far ahead of all others, but a residual is left that it does not explain
};

}  // namespace levitas::diagnosis
