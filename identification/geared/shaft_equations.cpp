#include "identification/geared/shaft_equations.hpp"

#include <array>
#include <cmath>
#include <complex>

#include "identification/geared/geared_forces.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;
using Kind = GearedLine::Kind;

/// Share of a force that linear corrections of uncertain numbers leave unexplained.
constexpr double kLeftOver = 0.002;
constexpr double kHeldScale = 0.01;
/// Where the unknowns of the sum of both equations stand: ks_p, ki_p, ks_g, ki_g, then the
/// unbalances m eps (2 each).
/// Then, with uncertain known numbers, a relative correction of each.
constexpr Index kUnbalance = 4;
constexpr Index kUnknowns = 8;

/// Sensitivity of a shaft's force to a relative error of each known parameter.
double KnownSigma(const ShaftKnown& s, const GearedLine& line, Complex r, double uncertainty) {
  const double w = line.frequency_rad_per_s;
  const Complex stiff = s.stiffness_n_per_m - TiltSoftening(s, line);
  return uncertainty * std::abs(r) *
         std::hypot(std::abs(stiff), s.mass_kg * w * w, s.damping_n_s_per_m * w);
}

/// Unknowns of the corrections on one line: dZ/d(ln number) times the deflection.
void AddCorrections(const GearedLine& line, const GearedKnown& known, LineEquations& eq) {
  constexpr double kStep = 1e-4;
  Index at = kUnknowns;
  for (const bool pinion : {true, false}) {
    const ShaftKnown& shaft = pinion ? known.pinion : known.gear;
    const Complex own = Impedance(shaft, line);
    for (const Numbers& numbers : Correctable()) {
      ShaftKnown other = shaft;
      Scale(other, numbers, 1.0 + kStep);
      eq.Real(at++,
              -(Impedance(other, line) - own) / kStep * (pinion ? line.pinion_m : line.gear_m));
    }
  }
}

/// Rows that hold what is known to its uncertainty: the corrections, and the magnets' ks/ki.
void HoldTheKnown(const GearedKnown& known, LineEquations& eq, Index unknowns) {
  for (Index at = kUnknowns; at < unknowns; ++at) {
    eq.Real(at, 1.0);
    eq.Close(0.0, known.uncertainty);
  }
  // All forces could shrink together, and noise in the lines would make them: the mean correction
  // of mass, damping and stiffness is held at 0.
  for (Index at = kUnknowns; at < unknowns; ++at) {
    if ((at - kUnknowns) % static_cast<Index>(Correctable().size()) < 3) eq.Real(at, 1.0);
  }
  eq.Close(0.0, kHeldScale * known.uncertainty);
  for (const Index at : {Index{0}, Index{2}}) {
    const ShaftKnown& shaft = at == 0 ? known.pinion : known.gear;
    eq.Real(at, 1.0);
    eq.Real(at + 1, -shaft.ks_n_per_m / shaft.ki_n_per_a);
    eq.Close(0.0, known.uncertainty * shaft.ks_n_per_m);
  }
}

/// A line as its noise is best explained by the round before, and what that takes from the sum.
struct Cleaned {
  GearedLine line;
  Complex slack;
};

Cleaned Clean(const GearedLine& line, const GearedKnown& known, const GearedParameters& p) {
  Cleaned clean{line, 0.0};
  if (line.sigma_m <= 0.0 || p.pinion.ki_n_per_a <= 0.0) return clean;
  const double w = line.frequency_rad_per_s;
  const Complex pinion = Impedance(p.corrected.pinion, line) - p.pinion.ks_n_per_m;
  const Complex gear = Impedance(p.corrected.gear, line) - p.gear.ks_n_per_m;
  Complex sum = pinion * line.pinion_m + gear * line.gear_m + p.pinion.ki_n_per_a * line.pinion_a +
                p.gear.ki_n_per_a * line.gear_a;
  if (line.kind == Kind::kPinion) sum -= p.corrected.pinion.mass_kg * w * w * p.pinion.run_out_m;
  if (line.kind == Kind::kGear) sum -= p.corrected.gear.mass_kg * w * w * p.gear.run_out_m;
  const double sigma = SumSigma(line, known, p);
  const Complex share = sum / (2.0 * sigma * sigma);
  const double m = line.sigma_m * line.sigma_m;
  const double a = line.sigma_a * line.sigma_a;
  clean.line.pinion_m -= m * std::conj(pinion) * share;
  clean.line.gear_m -= m * std::conj(gear) * share;
  clean.line.pinion_a -= a * p.pinion.ki_n_per_a * share;
  clean.line.gear_a -= a * p.gear.ki_n_per_a * share;
  clean.slack =
      share *
      (m * (std::norm(pinion) + std::norm(gear)) +
       a * (p.pinion.ki_n_per_a * p.pinion.ki_n_per_a + p.gear.ki_n_per_a * p.gear.ki_n_per_a));
  return clean;
}

ShaftFound Found(const Solution& s, const ShaftKnown& known, Index at, Index unbalance) {
  ShaftFound found;
  found.ks_n_per_m = s.value[at];
  found.ks_sigma = s.sigma[at];
  found.ki_n_per_a = s.value[at + 1];
  found.ki_sigma = s.sigma[at + 1];
  found.run_out_m = Complex(s.value[unbalance], s.value[unbalance + 1]) / known.mass_kg;
  found.run_out_sigma = std::hypot(s.sigma[unbalance], s.sigma[unbalance + 1]) / known.mass_kg;
  return found;
}

}  // namespace

const std::vector<Numbers>& Correctable() {
  static const std::vector<Numbers> kCorrectable{
      {{&ShaftKnown::mass_kg},
       {&ShaftKnown::damping_n_s_per_m},
       {&ShaftKnown::stiffness_n_per_m, &ShaftKnown::coupling_n, &ShaftKnown::tilt_stiffness_n_m},
       {&ShaftKnown::diametral_kg_m2},
       {&ShaftKnown::polar_kg_m2}}};
  return kCorrectable;
}

void Scale(ShaftKnown& shaft, const Numbers& numbers, double factor) {
  for (double ShaftKnown::*number : numbers) shaft.*number *= factor;
}

double SumSigma(const GearedLine& line, const GearedKnown& known, const GearedParameters& p) {
  const double stiff = std::hypot(std::abs(Impedance(known.pinion, line) - p.pinion.ks_n_per_m),
                                  std::abs(Impedance(known.gear, line) - p.gear.ks_n_per_m));
  const double gain = std::hypot(p.pinion.ki_n_per_a, p.gear.ki_n_per_a);
  const double noise = std::hypot(stiff * line.sigma_m, gain * line.sigma_a);
  const double left = known.uncertainty > 0.0 ? kLeftOver : 0.0;
  const double model = std::hypot(KnownSigma(known.pinion, line, line.pinion_m, left),
                                  KnownSigma(known.gear, line, line.gear_m, left));
  const double sigma = std::hypot(noise, model) / std::sqrt(2.0);
  return sigma > 0.0 ? sigma : 1.0;
}

GearedKnown Corrected(const GearedKnown& known, const Solution& s) {
  GearedKnown corrected = known;
  if (s.value.size() == kUnknowns) return corrected;
  Index at = kUnknowns;
  for (ShaftKnown* shaft : {&corrected.pinion, &corrected.gear}) {
    for (const Numbers& numbers : Correctable()) Scale(*shaft, numbers, 1.0 + s.value[at++]);
  }
  return corrected;
}

Solution SolveShafts(const std::vector<GearedLine>& lines, const GearedKnown& known,
                     const GearedParameters& p) {
  const bool uncertain = known.uncertainty > 0.0;
  const Index corrections = uncertain ? static_cast<Index>(2 * Correctable().size()) : 0;
  const Index unknowns = kUnknowns + corrections;
  LineEquations eq(lines.size() + static_cast<std::size_t>(uncertain ? corrections + 3 : 0),
                   unknowns);
  for (const GearedLine& measured : lines) {
    const auto [line, slack] = Clean(measured, known, p);
    const double w = line.frequency_rad_per_s;
    eq.Real(0, line.pinion_m);
    eq.Real(1, -line.pinion_a);
    eq.Real(2, line.gear_m);
    eq.Real(3, -line.gear_a);
    if (line.kind == Kind::kPinion) eq.ComplexAt(kUnbalance, w * w);
    if (line.kind == Kind::kGear) eq.ComplexAt(kUnbalance + 2, w * w);
    if (uncertain) AddCorrections(line, known, eq);
    eq.Close(Impedance(known.pinion, line) * line.pinion_m +
                 Impedance(known.gear, line) * line.gear_m + slack,
             SumSigma(line, known, p));
  }
  if (uncertain) HoldTheKnown(known, eq, unknowns);
  return eq.Solve("ks, ki and the run-outs");
}

void TakeShafts(const Solution& solution, const GearedKnown& corrected, GearedParameters& p) {
  p.condition = solution.condition;
  p.corrected = corrected;
  p.pinion = Found(solution, corrected.pinion, 0, kUnbalance);
  p.gear = Found(solution, corrected.gear, 2, kUnbalance + 2);
}

}  // namespace levitas::identification
