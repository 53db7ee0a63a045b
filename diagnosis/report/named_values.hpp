#pragma once
// Parameters of the causes and calibrated values of an answer, under the keys and in the units of
// the rig file.
//
// Interval   of parameters 5 to 95 % (90 %): every estimate to either side, squares added. The form
//            of a law (knee, clearance, frequency of a support) is sought without one: there the
//            bracket is the distance to the neighbouring forms.
// Calibrated total values of all parameters but the causes, with their posterior std.
//            Harmonics are given as amplitude and phase; unbalance is the sum of the file's and the
//            estimate. A mode's shape has no key: its change is given as a share of its rms.
// Additions  an unbalance or a delay that is a cause stands in the list `effects`, and adds to the
//            file's `unbalance` and `delay_samples`.
// Thread     any; pure.

#include <complex>
#include <string>
#include <vector>

#include "diagnosis/report/diagnosis_report.hpp"
#include "diagnosis/report/effect_entry.hpp"

namespace levitas::diagnosis {

struct DiagnosisResult;
struct Estimate;

[[nodiscard]] std::vector<NamedParameter> Parameters(const DiagnosisResult& answer);
/// A cause under which the currents act earlier than the file says: no entry can say it, the file's
/// key `delay_samples` does.
[[nodiscard]] bool IsShorterDelay(const PlacedEffect& at);
/// Numbers of the calibration that a cause has made its own, and are therefore not calibrated.
[[nodiscard]] std::vector<std::string> TakenByCauses(const DiagnosisResult& answer);
/// Planes closer than this are one: a rig file has its lengths to a tenth of a millimetre.
inline constexpr double kSamePlaneM = 0.05e-3;
/// [kg m] Of the file at a plane: its masses, and entries of `effects` that act all the time.
[[nodiscard]] std::complex<double> UnbalanceOfFile(const RigView& rig, double z_m);
/// Those that lie furthest out of their tolerance first.
[[nodiscard]] std::vector<CalibratedValue> CalibratedValues(const DiagnosisResult& answer);

/// Terms of a list of estimates, those of one effect at one place together.
[[nodiscard]] std::vector<PlacedEffect> CausesByPlace(const DiagnosisResult& answer);
[[nodiscard]] std::vector<PlacedEffect> CalibrationByPlace(const DiagnosisResult& answer);

/// Of the parameter of a term; null where there is none.
[[nodiscard]] const Estimate* EstimateOf(const std::vector<Estimate>& estimates, std::size_t term);

}  // namespace levitas::diagnosis
