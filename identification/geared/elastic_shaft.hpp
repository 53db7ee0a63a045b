#pragma once
// A shaft whose gear, magnet and probe stand at planes of their own, on the lines of its spectrum:
// what one plane of probes and the magnet's current say of the gear.
//
// Model     modes q of one plane in r = x + jy, mass-normalised, W a line's frequency, w the
//           pinion's speed, K and C with the supports:
//             (K - W^2 + jW C + W w G) q = s_g F + s_a F_a,     H_ij = s_i' (...)^-1 s_j
//           G carries the ratio of the shaft's speed to the pinion's. F is what acts at the gear,
//           F_a = ks r_a - ki I what the magnet does.
// Observer  the probe and the magnet's law are two equations in F and F_a:
//             x = H_sg F + H_sa F_a,     F_a = ks (H_ag F + H_aa F_a) - ki I
//           with D = H_sg (1 - ks H_aa) + ks H_sa H_ag:
//             F = ((1 - ks H_aa) x + ki H_sa I)/D
//             r_g = ((H_gg (1 - ks H_aa) + ks H_ga H_ag) x + ki (H_gg H_sa - H_ga H_sg) I)/D
//           Exact: one force is unknown and one plane is measured. All planes at one place give
//           F = (Z - ks) x + ki I and r_g = x, Z = 1/H, as full_spectrum.hpp has it.
// Limit     D = 0 is a node: the probe does not see the gear's force on that line. What is wrong in
//           the shaft's model comes out times |r_g/x|, the amplification (probe_planes.hpp).
//           A second unknown force, an unbalance elsewhere on the shaft, has no equation.
// Units     SI, complex amplitudes. Thread any, pure.

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "identification/geared/full_spectrum.hpp"

namespace levitas::identification {

struct ElasticShaft {
  Eigen::MatrixXd stiffness_1_per_s2, damping_1_per_s;  ///< modal, with the supports
  Eigen::MatrixXd gyroscopic;                           ///< per unit speed of the pinion
  Eigen::VectorXd gear, magnet, probe;                  ///< deflections of the modes [1/sqrt(kg)]
  double gear_z_m{}, magnet_z_m{}, probe_z_m{};
};

/// Displacement per force between the planes [m/N]; symmetric, as the modal matrices are.
struct Receptances {
  std::complex<double> gear, gear_magnet, gear_probe, magnet, magnet_probe;
};

/// With the ratios of `shaft` to its elastic model, which it must have.
[[nodiscard]] Receptances ReceptancesOf(const ShaftKnown& shaft, const GearedLine& line);

/// F and r_g per reading x of the probe and per current I.
struct ShaftGains {
  std::complex<double> force_per_m, force_per_a;
  std::complex<double> gear_per_m, gear_per_a;
};
[[nodiscard]] ShaftGains GainsOf(const Receptances& h, double ks_n_per_m, double ki_n_per_a);

/// Of both shafts of a line; empty where a disc is the only plane of its shaft.
struct LineGains {
  std::optional<ShaftGains> pinion, gear;
};
/// With ks and ki of `found`. A factorisation for each elastic shaft.
[[nodiscard]] LineGains GainsOn(const GearedLine& line, const GearedKnown& known,
                                const GearedParameters& found);
[[nodiscard]] std::vector<LineGains> GainsOn(const std::vector<GearedLine>& lines,
                                             const GearedKnown& known,
                                             const GearedParameters& found);

/// The gains of either kind of shaft; a disc has its own deflection, and Z - ks.
[[nodiscard]] ShaftGains EitherGains(const std::optional<ShaftGains>& elastic,
                                     const ShaftKnown& shaft, const GearedLine& line,
                                     const ShaftFound& found);

/// F by ks and ki at given ones: F(ks, ki) = rest + by_ks ks + by_ki ki to first order.
struct ForceTerms {
  std::complex<double> rest, by_ks, by_ki;
};
[[nodiscard]] ForceTerms ForceTermsOf(const Receptances& h, std::complex<double> probe_m,
                                      std::complex<double> current_a, double ks_n_per_m,
                                      double ki_n_per_a);

/// Displacements of both gears.
struct GearMotion {
  std::complex<double> pinion_m, gear_m;
};
[[nodiscard]] GearMotion GearMotionOf(const GearedLine& line, const LineGains& gains);

}  // namespace levitas::identification
