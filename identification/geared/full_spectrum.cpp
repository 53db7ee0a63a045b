#include "identification/geared/full_spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "common/problem.hpp"
#include "identification/geared/geared_forces.hpp"
#include "identification/geared/imaginary_unit.hpp"
#include "identification/geared/joint_fit.hpp"
#include "identification/geared/line_equations.hpp"
#include "identification/geared/probe_planes.hpp"
#include "identification/geared/shaft_equations.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Kind = GearedLine::Kind;

/// Weights depend on what is sought: a few rounds settle them.
constexpr int kRounds = 8;
/// Noise and a poor rig file stay below; a wrong sign does not.
constexpr double kMostUnexplained = 0.3;
/// The same in standard deviations of what is known: with wrong numbers that nearly cancel in the
/// sum of both equations, a large share unexplained is no more than was to be expected.
constexpr double kMostSigmas = 3.0;

/// Standard deviation of a line's mesh force, and of k D on its other side.
double MeshSigma(const GearedLine& line, const GearedKnown& known, const GearedParameters& p,
                 const LineGains& gains) {
  if (line.sigma_m <= 0.0 && known.uncertainty <= 0.0) return 1.0;
  const double k = std::abs(
      Complex(p.mesh_stiffness_n_per_m, line.frequency_rad_per_s * p.mesh_damping_n_s_per_m));
  const double sum = 0.5 * std::sqrt(2.0) * SumSigma(line, known, p);
  if (!gains.pinion && !gains.gear) return std::hypot(sum, std::sqrt(2.0) * k * line.sigma_m);
  const ShaftGains pinion = EitherGains(gains.pinion, known.pinion, line, p.pinion);
  const ShaftGains gear = EitherGains(gains.gear, known.gear, line, p.gear);
  return std::hypot(
      sum, k * line.sigma_m * std::hypot(std::abs(pinion.gear_per_m), std::abs(gear.gear_per_m)));
}

struct Teeth {
  std::vector<LineGains> gains;
  std::vector<Complex> force, twist;
  std::vector<GearMotion> gears;
};

Teeth TeethOf(const std::vector<GearedLine>& lines, const GearedKnown& known,
              const GearedParameters& p) {
  Teeth teeth;
  teeth.gains = GainsOn(lines, known, p);
  for (std::size_t n = 0; n < lines.size(); ++n) {
    teeth.force.push_back(MeshForce(lines[n], known, p, teeth.gains[n]));
    teeth.gears.push_back(GearMotionOf(lines[n], teeth.gains[n]));
  }
  teeth.twist = TwistOnLines(lines, teeth.force, TwistPerForceOn(lines, known.torsion),
                             known.torsion ? known.torsion->normal : 0.0);
  return teeth;
}

void SolveMesh(const std::vector<GearedLine>& lines, const GearedKnown& known, const Teeth& teeth,
               GearedParameters& p) {
  const auto rotates = [](const GearedLine& line) { return line.kind != Kind::kTransmissionError; };
  const auto count = static_cast<std::size_t>(std::ranges::count_if(lines, rotates));
  LineEquations eq(count, 2);
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const GearedLine& line = lines[n];
    if (!rotates(line)) continue;
    Complex deflection = teeth.gears[n].pinion_m - teeth.gears[n].gear_m + teeth.twist[n];
    if (line.kind == Kind::kPinion) deflection += p.pinion.run_out_m;
    if (line.kind == Kind::kGear) deflection -= p.gear.run_out_m;
    eq.Real(0, deflection);
    eq.Real(1, kJ * line.frequency_rad_per_s * deflection);
    eq.Close(teeth.force[n], MeshSigma(line, known, p, teeth.gains[n]));
  }
  const Solution mesh = eq.Solve("mesh stiffness and damping");
  p.mesh_stiffness_n_per_m = mesh.value[0];
  // The mesh force is told by the currents: what ki is off by, it is off by on every line.
  const double gain = std::hypot(p.pinion.ki_sigma, p.gear.ki_sigma) /
                      std::min(p.pinion.ki_n_per_a, p.gear.ki_n_per_a);
  p.mesh_stiffness_sigma = std::hypot(mesh.sigma[0], gain * mesh.value[0]);
  p.mesh_damping_n_s_per_m = mesh.value[1];
  p.mesh_damping_sigma = mesh.sigma[1];
}

void SolveErrors(const std::vector<GearedLine>& lines, const GearedKnown& known, const Teeth& teeth,
                 GearedParameters& p) {
  struct Sample {
    Complex value;
    double weight;
  };
  std::map<int, std::vector<Sample>> found;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const GearedLine& line = lines[n];
    if (line.kind != Kind::kTransmissionError) continue;
    const Complex mesh(p.mesh_stiffness_n_per_m,
                       line.frequency_rad_per_s * p.mesh_damping_n_s_per_m);
    Complex e =
        teeth.gears[n].pinion_m - teeth.gears[n].gear_m + teeth.twist[n] - teeth.force[n] / mesh;
    if (known.torsion && line.frequency_rad_per_s == 0.0) {
      const Complex unit = known.torsion->normal;
      e -= unit * (std::conj(unit) * e).real();
      p.mean_along_line_unknown = true;
    }
    const double sigma = MeshSigma(line, known, p, teeth.gains[n]) / std::abs(mesh);
    found[line.harmonic].push_back({e, 1.0 / (sigma * sigma)});
  }
  for (const auto& [harmonic, samples] : found) {
    double weight = 0.0;
    Complex mean = 0.0;
    for (const Sample& s : samples) {
      weight += s.weight;
      mean += s.weight * s.value;
    }
    mean /= weight;
    double scatter = 0.0;
    for (const Sample& s : samples) scatter += s.weight * std::norm(s.value - mean);
    const double n = std::max<double>(2.0, static_cast<double>(samples.size()));
    p.error.push_back({harmonic, mean, std::sqrt(scatter / (weight * (n - 1.0)))});
  }
}

/// A magnet pushes the way its current goes, and the lines obey the model: else a sign is wrong.
void RefuseWrongSigns(const GearedParameters& p, const Solution& shafts) {
  if (shafts.unexplained > kMostUnexplained && shafts.sigmas > kMostSigmas) {
    throw BadInput(fmt::format(
        "full spectrum: {:.0f} % of the forces on the shafts remain unexplained: a channel is dead "
        "or has the wrong sign, or the rig file is of another rig",
        100.0 * shafts.unexplained));
  }
  for (const ShaftFound* shaft : {&p.pinion, &p.gear}) {
    if (shaft->ki_n_per_a > 0.0) continue;
    throw BadInput(fmt::format(
        "full spectrum: ki of the {} comes out as {:.1f} N/A: the sign of its probes or of its "
        "current is wrong in the record or in the rig file",
        shaft == &p.pinion ? "pinion" : "gear", shaft->ki_n_per_a));
  }
}

/// Noise or doubt, that can be weighed.
bool IsWeighted(const std::vector<GearedLine>& lines, const GearedKnown& known) {
  return known.uncertainty > 0.0 ||
         std::ranges::all_of(lines, [](const auto& l) { return l.sigma_m > 0.0; });
}

GearedParameters Fit(const std::vector<GearedLine>& lines, const GearedKnown& known) {
  GearedParameters p;
  // An elastic shaft's force is no linear function of ks: rounds are Newton steps.
  const bool again = IsWeighted(lines, known) || known.pinion.elastic || known.gear.elastic;
  for (int round = 0; round < (again ? kRounds : 1); ++round) {
    const Solution shafts = SolveShafts(lines, known, p);
    const GearedKnown corrected = Corrected(known, shafts);
    TakeShafts(shafts, corrected, p);
    RefuseWrongSigns(p, shafts);
    const Teeth teeth = TeethOf(lines, corrected, p);
    SolveMesh(lines, corrected, teeth, p);
    p.error.clear();
    SolveErrors(lines, corrected, teeth, p);
  }
  return p;
}

}  // namespace

GearedParameters IdentifyGeared(const std::vector<GearedLine>& all, const GearedKnown& known) {
  const std::string lacks = WhatLacks(all);
  if (!lacks.empty()) throw BadInput(fmt::format("full spectrum: {}", lacks));
  const std::vector<GearedLine> lines = LinesOffNodes(all, known);
  GearedParameters p = Fit(lines, known);
  if (IsWeighted(lines, known)) FitJointly(lines, known, p);
  TellProbePlanes(all, lines, known, p);
  return p;
}

}  // namespace levitas::identification
