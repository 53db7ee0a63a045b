#include "identification/geared/elastic_shaft.hpp"

#include <Eigen/LU>

#include "identification/geared/geared_forces.hpp"
#include "identification/geared/imaginary_unit.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;

Complex GearOf(const std::optional<ShaftGains>& gains, Complex probe_m, Complex current_a) {
  return gains ? gains->gear_per_m * probe_m + gains->gear_per_a * current_a : probe_m;
}

}  // namespace

Receptances ReceptancesOf(const ShaftKnown& shaft, const GearedLine& line) {
  const ElasticShaft& e = *shaft.elastic;
  const double w = line.frequency_rad_per_s;
  Eigen::MatrixXcd dynamic = (shaft.stiffness_ratio * e.stiffness_1_per_s2 +
                              shaft.gyroscopic_ratio * w * line.speed_rad_per_s * e.gyroscopic)
                                 .cast<Complex>() +
                             kJ * w * shaft.damping_ratio * e.damping_1_per_s.cast<Complex>();
  dynamic.diagonal().array() -= shaft.mass_ratio * w * w;
  Eigen::MatrixXcd at(e.gear.size(), 2);
  at << e.gear.cast<Complex>(), e.magnet.cast<Complex>();
  const Eigen::MatrixXcd answer = dynamic.partialPivLu().solve(at);
  const auto of = [&answer](const Eigen::VectorXd& plane, Eigen::Index force) {
    return (plane.cast<Complex>().transpose() * answer.col(force))(0);
  };
  return {of(e.gear, 0), of(e.gear, 1), of(e.probe, 0), of(e.magnet, 1), of(e.probe, 1)};
}

LineGains GainsOn(const GearedLine& line, const GearedKnown& known, const GearedParameters& p) {
  const auto of = [&line](const ShaftKnown& shaft, const ShaftFound& found) {
    return GainsOf(ReceptancesOf(shaft, line), found.ks_n_per_m, found.ki_n_per_a);
  };
  LineGains gains;
  if (known.pinion.elastic) gains.pinion = of(known.pinion, p.pinion);
  if (known.gear.elastic) gains.gear = of(known.gear, p.gear);
  return gains;
}

std::vector<LineGains> GainsOn(const std::vector<GearedLine>& lines, const GearedKnown& known,
                               const GearedParameters& p) {
  std::vector<LineGains> gains;
  gains.reserve(lines.size());
  for (const GearedLine& line : lines) gains.push_back(GainsOn(line, known, p));
  return gains;
}

ShaftGains GainsOf(const Receptances& h, double ks, double ki) {
  const Complex free = 1.0 - ks * h.magnet;
  const Complex node = h.gear_probe * free + ks * h.magnet_probe * h.gear_magnet;
  return {free / node, ki * h.magnet_probe / node,
          (h.gear * free + ks * h.gear_magnet * h.gear_magnet) / node,
          ki * (h.gear * h.magnet_probe - h.gear_magnet * h.gear_probe) / node};
}

ShaftGains EitherGains(const std::optional<ShaftGains>& elastic, const ShaftKnown& shaft,
                       const GearedLine& line, const ShaftFound& found) {
  if (elastic) return *elastic;
  return {Impedance(shaft, line) - found.ks_n_per_m, found.ki_n_per_a, 1.0, 0.0};
}

ForceTerms ForceTermsOf(const Receptances& h, Complex probe_m, Complex current_a, double ks,
                        double ki) {
  const Complex free = 1.0 - ks * h.magnet;
  const Complex node = h.gear_probe * free + ks * h.magnet_probe * h.gear_magnet;
  const Complex force = (free * probe_m + ki * h.magnet_probe * current_a) / node;
  const Complex by_ki = h.magnet_probe * current_a / node;
  const Complex node_by_ks = h.magnet_probe * h.gear_magnet - h.gear_probe * h.magnet;
  const Complex by_ks = -(h.magnet * probe_m + force * node_by_ks) / node;
  return {force - by_ks * ks - by_ki * ki, by_ks, by_ki};
}

GearMotion GearMotionOf(const GearedLine& line, const LineGains& gains) {
  return {GearOf(gains.pinion, line.pinion_m, line.pinion_a),
          GearOf(gains.gear, line.gear_m, line.gear_a)};
}

}  // namespace levitas::identification
