#pragma once
// Keys and values of a cause as one entry of the list `effects` of a rig file.
//
// Keys     those of docs/effects.md with their units, so that what is printed can be copied into a
//          file.
// From     the parameters of the terms at one place: cosine and sine become amplitude and phase,
//          sqrt(tau) becomes tau, ratios the factor on the nominal value; the form of a law (knee,
//          clearance, frequency of a support) is the shape of its family.
// Thread   any; pure. Failure: an effect without an entry has no values.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/model/term.hpp"

namespace levitas::diagnosis {

/// One key of an entry and its number in the unit of the key.
struct EntryValue {
  std::string key;
  double number{};
  int digits{6};  ///< significant ones in a file
};
using EntryValues = std::vector<EntryValue>;

/// Phases and directions are reported in the unit of rig files.
inline constexpr const char* kPhaseKey = "phase_deg";
/// A delay is shorter than the file's only under the file's own key: entries add to it.
inline constexpr const char* kDelaySamplesKey = "delay_samples";
[[nodiscard]] EntryValue PhaseValue(double phase_rad);

/// The terms of one effect at one place, by parameter.
struct PlacedEffect {
  std::optional<effect::Id> effect;  ///< none: a part of the model that healthy rigs differ in
  Location location;
  Family::Shape shape;  ///< form of the law; empty where it has one form
  std::map<std::string, double> theta;
  std::map<std::string, std::size_t> term;  ///< index of each parameter's term

  [[nodiscard]] std::string_view effect_name() const;
  [[nodiscard]] double At(const std::string& parameter) const;
  [[nodiscard]] double Amplitude() const;
  [[nodiscard]] double Phase() const;
};

/// Numbers that stand in the entry; an effect of the catalogue only.
[[nodiscard]] EntryValues ValuesOf(const RigView& rig, const PlacedEffect& at);
/// The entry that a rig file takes, its numbers rounded to their digits: what is printed is what
/// acts. A key that is not given has the fallback of the catalogue. Nothing where a number is not
/// finite. Failure: std::logic_error for a missing key without a fallback.
[[nodiscard]] std::optional<effect::EffectConfig> MakeEntry(effect::Id id, const Location& at,
                                                            std::size_t axes_of_rig,
                                                            const EntryValues& values);
/// The same of terms; nothing for an effect without an entry.
[[nodiscard]] std::optional<effect::EffectConfig> EntryFor(const RigView& rig,
                                                           const PlacedEffect& at);

/// The unit that a key ends in.
struct KeyUnit {
  std::string symbol;  ///< empty: a pure number
  double si{1.0};      ///< of one unit
};
[[nodiscard]] KeyUnit UnitOfKey(const std::string& key);

}  // namespace levitas::diagnosis
