#pragma once
// Keys and values of a cause as one entry of the list `effects` of a rig file.
//
// Keys     those of docs/effects.md with their units, so that what is printed can be copied into a
//          file.
// From     the parameters of the terms at one place: cosine and sine become amplitude and phase,
//          sqrt(tau) becomes tau, ratios the factor on the nominal value; shapes of a family are
//          read off the place that names them.
// Thread   any; pure. Failure: an effect without an entry has no values.

#include <map>
#include <string>
#include <vector>

#include "diagnosis/model/rig_view.hpp"

namespace levitas::diagnosis {

/// One key of an entry: a number, or words where `text` is not empty.
struct EntryValue {
  std::string key;
  double number{};
  std::string text;
  int digits{6};

  [[nodiscard]] bool is_number() const noexcept { return text.empty(); }
};
using EntryValues = std::vector<EntryValue>;

/// Phases and directions are reported in the unit of rig files.
inline constexpr const char* kPhaseKey = "phase_deg";
[[nodiscard]] EntryValue PhaseValue(double phase_rad);

/// The terms of one cause at one place, by parameter.
struct PlacedEffect {
  std::string effect, place;
  std::map<std::string, double> theta;

  [[nodiscard]] double At(const std::string& parameter) const;
  [[nodiscard]] double Amplitude() const;
  [[nodiscard]] double Phase() const;
  /// The first number in the place: "mode 2", "order -3", "z 299.2 mm", "90 Hz".
  [[nodiscard]] double Number() const;
  [[nodiscard]] std::string After(const std::string& comma) const;
};

[[nodiscard]] EntryValues ValuesOf(const RigView& rig, const PlacedEffect& at);
/// One YAML flow mapping: "{id: eddy_current, channels: [de_x], tau_us: 3}"; empty without values.
[[nodiscard]] std::string EntryText(const std::string& effect, const EntryValues& values);

/// The unit that a key ends in.
struct KeyUnit {
  std::string symbol;  ///< empty: a pure number
  double si{1.0};      ///< of one unit
};
[[nodiscard]] KeyUnit UnitOfKey(const std::string& key);

}  // namespace levitas::diagnosis
