#pragma once
// Forces on the lines of a geared rotor: what the shafts need, what the teeth give, how far the
// wheels turn under it. Equations: full_spectrum.hpp. Thread any, pure.

#include "identification/geared/elastic_shaft.hpp"
#include "identification/geared/full_spectrum.hpp"

namespace levitas::identification {

/// Z of one shaft at a line, whose disc is its only plane.
[[nodiscard]] std::complex<double> Impedance(const ShaftKnown& shaft, const GearedLine& line);

/// k_aa - I_d W^2 + I_p w W turned into what the tilt takes from Z; 0 without tilt.
[[nodiscard]] std::complex<double> TiltSoftening(const ShaftKnown& shaft, const GearedLine& line);

/// f from what either shaft needs. `gains`: GainsOn of this line and these.
struct MeshForces {
  std::complex<double> from_pinion, from_gear;
};
[[nodiscard]] MeshForces MeshForcesOf(const GearedLine& line, const GearedKnown& known,
                                      const GearedParameters& found, const LineGains& gains = {});

/// The mean of the two accounts.
[[nodiscard]] std::complex<double> MeshForce(const GearedLine& line, const GearedKnown& known,
                                             const GearedParameters& found,
                                             const LineGains& gains = {});

/// Whether a line is that of this speed and signed frequency.
[[nodiscard]] bool StandsAt(const GearedLine& line, double speed_rad_per_s, double w_rad_per_s);

/// The force of the line that stands there; none where there is no such line.
[[nodiscard]] std::optional<std::complex<double>> ForceAt(
    const std::vector<GearedLine>& lines, const std::vector<std::complex<double>>& force,
    double speed_rad_per_s, double w_rad_per_s);

/// Rotation along `shape` (per torsional mode) per force along n, which turns the wheels by
/// `twist_m`. Not for W = 0: the train may turn freely.
[[nodiscard]] std::complex<double> TwistBetween(const TorsionKnown& torsion,
                                                const Eigen::VectorXd& shape, double w_rad_per_s);

/// w along n per force along n: -w/F_n. Not for W = 0: the train may turn freely.
[[nodiscard]] std::complex<double> TwistPerForce(const TorsionKnown& torsion, double w_rad_per_s);

/// The same on every line; zero without torsion, and on lines at rest. Lines of one frequency share
/// a factorisation with the line before, forward or backward.
[[nodiscard]] std::vector<std::complex<double>> TwistPerForceOn(
    const std::vector<GearedLine>& lines, const std::optional<TorsionKnown>& torsion);

/// n w on every line from its force; `per_force`: TwistPerForceOn of these lines, `normal`: n.
[[nodiscard]] std::vector<std::complex<double>> TwistOnLines(
    const std::vector<GearedLine>& lines, const std::vector<std::complex<double>>& force,
    const std::vector<std::complex<double>>& per_force, std::complex<double> normal);

}  // namespace levitas::identification
