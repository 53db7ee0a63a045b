#pragma once
// Everything a rig may differ by, place by place. Each list is complete for a rig with radial
// bearings; what cannot act in it (orders without rotation) has sensitivities of zero and drops out
// by itself.
//
// Definitions  as in docs/effects.md: parameters have the meaning and the unit they have in a rig
//              file.
// Tolerances   what a rig that counts as healthy may differ by; 0 = not a nuisance.
// Thread       any.

#include <vector>

#include "configuration/tolerances.hpp"
#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/model/term.hpp"

namespace levitas::diagnosis {

using configuration::Tolerances;

/// Parameters of `eddy_current`: the whole force lags, or that of the current alone.
inline constexpr const char* kRootTau = "sqrt(tau_s)";
inline constexpr const char* kRootTauOfCurrent = "sqrt(tau_s) of the current";

/// [N] what a current beside that of the model changes at the magnet of an axis. Not its slope
/// times the current: a current that follows noise moves by tenths of the bias, and the square of
/// that does not average out.
[[nodiscard]] double ForceOfCurrent(const RigView& rig, const SamplePoint& moment, std::size_t axis,
                                    double beside_a);
/// [s] time constant of an axis' sensor.
[[nodiscard]] double SensorLag(const RigView& rig, std::size_t axis);

[[nodiscard]] std::vector<Term> MagnetTerms(const RigView& rig, const Tolerances& tolerances);
[[nodiscard]] std::vector<Term> MagnetMemoryTerms(const RigView& rig);
[[nodiscard]] std::vector<Term> TimingTerms(const RigView& rig, const Tolerances& tolerances);
[[nodiscard]] std::vector<Term> SensorTerms(const RigView& rig, const Tolerances& tolerances);
[[nodiscard]] std::vector<Term> RotorTerms(const RigView& rig, const Tolerances& tolerances);
[[nodiscard]] std::vector<Term> RotatingTerms(const RigView& rig, const Tolerances& tolerances);
[[nodiscard]] std::vector<Term> CrackTerms(const RigView& rig);
[[nodiscard]] std::vector<Term> ExternalTerms(const RigView& rig, const Tolerances& tolerances,
                                              double largest_orbit_m);
/// Teeth, wheels and shafts; empty for a rig with one rotor.
[[nodiscard]] std::vector<Term> GearTerms(const RigView& rig, const Tolerances& tolerances);

/// Depth, as a share of the diameter (0 to 0.5), of the crack that `theta` of a crack term at z is.
[[nodiscard]] double CrackDepth(const RigView& rig, double z_m, double theta);

/// Pickup with a phase of its own in every record: only the lines that a record shows.
[[nodiscard]] std::vector<Term> MainsTerms(const RigView& rig,
                                           const std::vector<double>& frequencies_hz,
                                           std::size_t records);

/// All of them but the mains, in that order.
[[nodiscard]] std::vector<Term> AllTerms(const RigView& rig, const Tolerances& tolerances,
                                         double largest_orbit_m);

}  // namespace levitas::diagnosis
