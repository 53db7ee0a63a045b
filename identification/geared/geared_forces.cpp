#include "identification/geared/geared_forces.hpp"

#include <Eigen/LU>
#include <cmath>

#include "identification/geared/imaginary_unit.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using Kind = GearedLine::Kind;

}  // namespace

bool StandsAt(const GearedLine& line, double speed_rad_per_s, double w_rad_per_s) {
  constexpr double kSame = 1e-6;
  return line.speed_rad_per_s == speed_rad_per_s &&
         std::abs(line.frequency_rad_per_s - w_rad_per_s) <= kSame * std::abs(w_rad_per_s);
}

std::optional<Complex> ForceAt(const std::vector<GearedLine>& lines,
                               const std::vector<Complex>& force, double speed_rad_per_s,
                               double w_rad_per_s) {
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (StandsAt(lines[k], speed_rad_per_s, w_rad_per_s)) return force[k];
  }
  return std::nullopt;
}

Complex TiltSoftening(const ShaftKnown& s, const GearedLine& line) {
  if (s.tilt_stiffness_n_m <= 0.0) return 0.0;
  const double w = line.frequency_rad_per_s;
  const double tilt = s.tilt_stiffness_n_m - s.diametral_kg_m2 * w * w +
                      s.polar_kg_m2 * s.ratio * line.speed_rad_per_s * w;
  return s.coupling_n * s.coupling_n / tilt;
}

Complex Impedance(const ShaftKnown& s, const GearedLine& line) {
  const double w = line.frequency_rad_per_s;
  return Complex(s.stiffness_n_per_m - s.mass_kg * w * w, w * s.damping_n_s_per_m) -
         TiltSoftening(s, line);
}

MeshForces MeshForcesOf(const GearedLine& line, const GearedKnown& known, const GearedParameters& p,
                        const LineGains& gains) {
  const double w = line.frequency_rad_per_s;
  const auto elastic = [](const ShaftGains& of, Complex m, Complex a) {
    return of.force_per_m * m + of.force_per_a * a;
  };
  Complex from_pinion = gains.pinion ? -elastic(*gains.pinion, line.pinion_m, line.pinion_a)
                                     : p.pinion.ks_n_per_m * line.pinion_m -
                                           p.pinion.ki_n_per_a * line.pinion_a -
                                           Impedance(known.pinion, line) * line.pinion_m;
  Complex from_gear = gains.gear
                          ? elastic(*gains.gear, line.gear_m, line.gear_a)
                          : Impedance(known.gear, line) * line.gear_m -
                                p.gear.ks_n_per_m * line.gear_m + p.gear.ki_n_per_a * line.gear_a;
  if (line.kind == Kind::kPinion) {
    from_pinion += known.pinion.mass_kg * w * w * p.pinion.run_out_m;
  }
  if (line.kind == Kind::kGear) from_gear -= known.gear.mass_kg * w * w * p.gear.run_out_m;
  return {from_pinion, from_gear};
}

Complex MeshForce(const GearedLine& line, const GearedKnown& known, const GearedParameters& p,
                  const LineGains& gains) {
  const MeshForces both = MeshForcesOf(line, known, p, gains);
  return 0.5 * (both.from_pinion + both.from_gear);
}

Complex TwistBetween(const TorsionKnown& t, const Eigen::VectorXd& shape, double w) {
  const Eigen::Index n = t.frequency_rad_per_s.size();
  Eigen::MatrixXcd dynamic = kJ * w * t.damping_1_per_s.cast<Complex>();
  for (Eigen::Index i = 0; i < n; ++i) {
    const double own = t.frequency_rad_per_s[i];
    dynamic(i, i) += Complex(own * own - w * w, 2.0 * t.damping_ratio[i] * own * w);
  }
  const Eigen::VectorXcd twist = t.twist_m.cast<Complex>();
  return (shape.cast<Complex>().transpose() * dynamic.partialPivLu().solve(twist))(0);
}

Complex TwistPerForce(const TorsionKnown& t, double w) { return TwistBetween(t, t.twist_m, w); }

std::vector<Complex> TwistPerForceOn(const std::vector<GearedLine>& lines,
                                     const std::optional<TorsionKnown>& torsion) {
  std::vector<Complex> per_force(lines.size(), 0.0);
  if (!torsion) return per_force;
  double last = 0.0;
  Complex found = 0.0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const double w = lines[k].frequency_rad_per_s;
    if (w == 0.0) continue;
    if (std::abs(w) != last) {
      last = std::abs(w);
      found = TwistPerForce(*torsion, last);
    }
    per_force[k] = w > 0.0 ? found : std::conj(found);
  }
  return per_force;
}

std::vector<Complex> TwistOnLines(const std::vector<GearedLine>& lines,
                                  const std::vector<Complex>& force,
                                  const std::vector<Complex>& per_force, Complex normal) {
  std::vector<Complex> twist(lines.size(), 0.0);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (per_force[k] == 0.0) continue;
    const Complex mirror =
        ForceAt(lines, force, lines[k].speed_rad_per_s, -lines[k].frequency_rad_per_s)
            .value_or(0.0);
    const Complex along = 0.5 * (std::conj(normal) * force[k] + normal * std::conj(mirror));
    twist[k] = -normal * per_force[k] * along;
  }
  return twist;
}

}  // namespace levitas::identification
