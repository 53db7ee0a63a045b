#include "benchmark/accuracy/identification/geared_trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "common/random.hpp"
#include "identification/geared/record_lines.hpp"
#include "plant_sim/gear/mesh.hpp"

namespace levitas::accuracy {
namespace {

using Complex = std::complex<double>;
using identification::GearedLine;

void Spoil(std::vector<GearedLine>& lines, double noise, double samples, Random& random) {
  double position = 0.0;
  double current = 0.0;
  for (const GearedLine& l : lines) {
    position += 0.5 * (std::norm(l.pinion_m) + std::norm(l.gear_m));
    current += 0.5 * (std::norm(l.pinion_a) + std::norm(l.gear_a));
  }
  const double sigma_m = noise * std::sqrt(position / samples);
  const double sigma_a = noise * std::sqrt(current / samples);
  const auto draw = [&random] {
    return Complex(random.Normal(), random.Normal()) / std::numbers::sqrt2;
  };
  for (GearedLine& l : lines) {
    l.pinion_m += sigma_m * draw();
    l.gear_m += sigma_m * draw();
    l.pinion_a += sigma_a * draw();
    l.gear_a += sigma_a * draw();
    l.sigma_m = sigma_m;
    l.sigma_a = sigma_a;
  }
}

void Mislead(identification::ShaftKnown& s, double error, Random& random) {
  for (double* value :
       {&s.mass_kg, &s.damping_n_s_per_m, &s.diametral_kg_m2, &s.polar_kg_m2, &s.ks_n_per_m}) {
    *value *= 1.0 + (random.Uniform() < 0.5 ? -error : error);
  }
  const double stiffer = 1.0 + (random.Uniform() < 0.5 ? -error : error);
  s.stiffness_n_per_m *= stiffer;
  s.coupling_n *= stiffer;
  s.tilt_stiffness_n_m *= stiffer;
}

/// Inertias and springs of the drawing, each off by itself; base radii follow from the teeth.
void MisleadTorsion(const configuration::RigFile& rig, double error, Random& random,
                    identification::GearedKnown& known) {
  if (!known.torsion) return;
  configuration::RigFile drawn = rig;
  for (rotor::Shaft& shaft : drawn.plant.shafts) {
    for (auto& inertia : shaft.torsion.inertias) {
      for (double* value : {&inertia.inertia_kg_m2, &inertia.stiffness_n_m_per_rad}) {
        *value *= 1.0 + (random.Uniform() < 0.5 ? -error : error);
      }
    }
  }
  known.torsion = identification::KnownOfRig(drawn).torsion;
}

double Relative(double found, double truth) { return std::abs(found / truth - 1.0); }

}  // namespace

GearedTrial MakeGearedTrial(const configuration::RigFile& rig, const GearedPlan& plan) {
  GearedTrial trial{{}, identification::KnownOfRig(rig)};
  Random random(plan.seed);
  for (const double hz : plan.speeds_hz) {
    auto lines = LinesAt(rig, plan, 2.0 * std::numbers::pi * hz);
    if (plan.noise > 0.0) {
      Spoil(lines, plan.noise, plan.seconds / rig.numbers.period_s(), random);
    }
    trial.lines.insert(trial.lines.end(), lines.begin(), lines.end());
  }
  if (plan.model_error > 0.0) {
    Mislead(trial.known.pinion, plan.model_error, random);
    Mislead(trial.known.gear, plan.model_error, random);
    MisleadTorsion(rig, plan.model_error, random, trial.known);
    trial.known.uncertainty = plan.model_error;
  }
  return trial;
}

GearedErrors Compare(const configuration::RigFile& rig,
                     const identification::GearedParameters& found) {
  const std::array<double, 2> known_n_per_m{found.corrected.pinion.stiffness_n_per_m,
                                            found.corrected.gear.stiffness_n_per_m};
  const gear::GearPair& pair = rig.plant.gears.front();
  GearedErrors errors;
  errors.mesh_stiffness = Relative(found.mesh_stiffness_n_per_m, pair.stiffness_n_per_m);
  errors.mesh_damping = Relative(found.mesh_damping_n_s_per_m, pair.damping_n_s_per_m);
  for (std::size_t s = 0; s < 2; ++s) {
    const identification::ShaftFound& shaft = s == 0 ? found.pinion : found.gear;
    const gear::Wheel& wheel = s == 0 ? pair.driving : pair.driven;
    const plant::BearingConfig& bearing = rig.plant.bearings[s];
    const double ks = KsOf(bearing);
    const double net = rig.plant.shafts[s].lumped.kll_n_per_m - ks;
    errors.ks = std::max(errors.ks, Relative(shaft.ks_n_per_m, ks));
    errors.ki = std::max(errors.ki, Relative(shaft.ki_n_per_a, KiOf(bearing)));
    errors.net_stiffness =
        std::max(errors.net_stiffness, Relative(known_n_per_m[s] - shaft.ks_n_per_m, net));
    errors.run_out = std::max(errors.run_out,
                              std::abs(shaft.run_out_m - RunOut(wheel)) / std::abs(RunOut(wheel)));
  }
  std::vector<double> varying;
  for (const identification::TransmissionError& e : found.error) {
    Complex truth = ErrorOf(pair, e.harmonic);
    if (e.harmonic == 0 && found.mean_along_line_unknown) {
      const gear::Vector n = gear::LineOfAction(pair.pressure_angle_rad);
      truth -= Complex(n.x, n.y) * (truth * Complex(n.x, -n.y)).real();
    }
    const double error = std::abs(e.amplitude_m - truth) / std::abs(truth);
    if (e.harmonic == 0) {
      errors.mean_error = error;
    } else {
      varying.push_back(error);
    }
  }
  std::ranges::sort(varying);
  if (!varying.empty()) errors.varying_error = varying[varying.size() / 2];
  return errors;
}

}  // namespace levitas::accuracy
