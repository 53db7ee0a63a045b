#pragma once
// The numbers of an answer under the keys and in the units of the rig file: parameters of the
// causes, and what the calibration has moved.
//
// Interval   of parameters 5 to 95 % (90 %): every estimate to either side, squares added. The form
//            of a law (knee, clearance, frequency of a support) is sought without one: there the
//            bracket is the distance to the neighbouring forms.
// Calibrated total values beside the causes, with the standard deviation that the data leave.
//            Harmonics are told as amplitude and phase; unbalance is the file's with what was
//            found. A mode's shape has no key: its change is told as a share of its rms.
// Thread     any; pure.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/effect_entry.hpp"

namespace levitas::diagnosis {

struct SessionAnswer;
struct Estimate;
struct Term;

struct NamedParameter {
  std::string effect, name, unit;  ///< name: "tau_us[de_x]"
  double value{}, low{}, high{};
  std::string key, place;  ///< "tau_us", "de_x"
  bool form{};             ///< the bracket is no interval but the distance to other forms
  double si{1.0};          ///< of one unit
};

struct CalibratedValue {
  std::string effect, place, key, unit;
  double nominal{};   ///< of the rig file
  double expected{};  ///< of earlier healthy records; else the nominal one
  double calibrated{};
  double deviation{};                                  ///< standard deviation that the data leave
  double tolerance{};                                  ///< standard deviation on a healthy rig
  std::optional<double> nominal_phase_rad, phase_rad;  ///< of a harmonic
  double moved{};                                      ///< from what was expected, in tolerances
  double proven{};                                     ///< the same in standard deviations
};

[[nodiscard]] std::vector<NamedParameter> Parameters(const SessionAnswer& answer);
/// Those that lie furthest out of their tolerance first.
[[nodiscard]] std::vector<CalibratedValue> CalibratedValues(const SessionAnswer& answer);
/// Moved by more than half a tolerance and more than two standard deviations.
[[nodiscard]] bool WorthTelling(const CalibratedValue& value);

/// Terms of a list of estimates, those of one effect at one place together.
[[nodiscard]] std::vector<PlacedEffect> CausesByPlace(const SessionAnswer& answer);
[[nodiscard]] std::vector<PlacedEffect> CalibrationByPlace(const SessionAnswer& answer);

/// Of a parameter at a place; null where there is none.
[[nodiscard]] const Estimate* EstimateOf(const std::vector<Estimate>& estimates,
                                         const PlacedEffect& at, const std::string& parameter);
[[nodiscard]] const Term* TermOf(const std::vector<Term>& terms, const PlacedEffect& at,
                                 const std::string& parameter);

}  // namespace levitas::diagnosis
