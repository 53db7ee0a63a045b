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

/// One shaft's share of a line, and what of it the round before found.
struct Share {
  const ShaftKnown& known;
  Complex probe_m, current_a;
  double ks_n_per_m, ki_n_per_a;
};

/// Of an elastic shaft. The first round starts from the magnet's drawing.
Share ShareOf(const GearedLine& line, const GearedKnown& known, const GearedParameters& p,
              bool pinion) {
  const ShaftKnown& shaft = pinion ? known.pinion : known.gear;
  const ShaftFound& found = pinion ? p.pinion : p.gear;
  const bool first = found.ki_n_per_a <= 0.0;
  return {shaft, pinion ? line.pinion_m : line.gear_m, pinion ? line.pinion_a : line.gear_a,
          first ? shaft.ks_n_per_m : found.ks_n_per_m, first ? shaft.ki_n_per_a : found.ki_n_per_a};
}

Complex ForceOf(const Share& share, const ShaftKnown& shaft, const GearedLine& line) {
  const ShaftGains gains = GainsOf(ReceptancesOf(shaft, line), share.ks_n_per_m, share.ki_n_per_a);
  return gains.force_per_m * share.probe_m + gains.force_per_a * share.current_a;
}

/// dF/d(ln number) of an elastic shaft, of each that can be off.
std::vector<Complex> ForceByKnown(const Share& share, const GearedLine& line) {
  constexpr double kStep = 1e-4;
  const Complex own = ForceOf(share, share.known, line);
  std::vector<Complex> by;
  for (const Numbers& numbers : Correctable()) {
    ShaftKnown other = share.known;
    Scale(other, numbers, 1.0 + kStep);
    by.push_back((ForceOf(share, other, line) - own) / kStep);
  }
  return by;
}

double ElasticSigma(const Share& share, const GearedLine& line, double uncertainty) {
  if (uncertainty <= 0.0) return 0.0;
  double square = 0.0;
  for (const Complex by : ForceByKnown(share, line)) square += std::norm(by);
  return uncertainty * std::sqrt(square);
}

/// Sensitivity of a shaft's force to a relative error of each known parameter.
double KnownSigma(const GearedLine& line, const GearedKnown& known, const GearedParameters& p,
                  bool pinion, double uncertainty) {
  const ShaftKnown& s = pinion ? known.pinion : known.gear;
  if (s.elastic) return ElasticSigma(ShareOf(line, known, p, pinion), line, uncertainty);
  const Complex r = pinion ? line.pinion_m : line.gear_m;
  const double w = line.frequency_rad_per_s;
  const Complex stiff = s.stiffness_n_per_m - TiltSoftening(s, line);
  return uncertainty * std::abs(r) *
         std::hypot(std::abs(stiff), s.mass_kg * w * w, s.damping_n_s_per_m * w);
}

/// Unknowns of the corrections on one line: dZ/d(ln number) times the deflection.
void AddCorrections(const GearedLine& line, const GearedKnown& known, const GearedParameters& p,
                    LineEquations& eq) {
  constexpr double kStep = 1e-4;
  Index at = kUnknowns;
  for (const bool pinion : {true, false}) {
    const ShaftKnown& shaft = pinion ? known.pinion : known.gear;
    if (shaft.elastic) {
      for (const Complex by : ForceByKnown(ShareOf(line, known, p, pinion), line)) {
        eq.Real(at++, -by);
      }
      continue;
    }
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

/// A shaft's force by ks and ki; linear as it is where a disc is the only plane.
ForceTerms TermsOf(const GearedLine& line, const GearedKnown& known, const GearedParameters& p,
                   bool pinion) {
  const ShaftKnown& shaft = pinion ? known.pinion : known.gear;
  const Complex r = pinion ? line.pinion_m : line.gear_m;
  if (!shaft.elastic) {
    return {Impedance(shaft, line) * r, -r, pinion ? line.pinion_a : line.gear_a};
  }
  const Share share = ShareOf(line, known, p, pinion);
  return ForceTermsOf(ReceptancesOf(shaft, line), share.probe_m, share.current_a, share.ks_n_per_m,
                      share.ki_n_per_a);
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
  const LineGains gains = GainsOn(line, p.corrected, p);
  const ShaftGains pinion = EitherGains(gains.pinion, p.corrected.pinion, line, p.pinion);
  const ShaftGains gear = EitherGains(gains.gear, p.corrected.gear, line, p.gear);
  Complex sum = pinion.force_per_m * line.pinion_m + gear.force_per_m * line.gear_m +
                pinion.force_per_a * line.pinion_a + gear.force_per_a * line.gear_a;
  if (line.kind == Kind::kPinion) sum -= p.corrected.pinion.mass_kg * w * w * p.pinion.run_out_m;
  if (line.kind == Kind::kGear) sum -= p.corrected.gear.mass_kg * w * w * p.gear.run_out_m;
  const double sigma = SumSigma(line, known, p);
  const Complex share = sum / (2.0 * sigma * sigma);
  const double m = line.sigma_m * line.sigma_m;
  const double a = line.sigma_a * line.sigma_a;
  clean.line.pinion_m -= m * std::conj(pinion.force_per_m) * share;
  clean.line.gear_m -= m * std::conj(gear.force_per_m) * share;
  clean.line.pinion_a -= a * std::conj(pinion.force_per_a) * share;
  clean.line.gear_a -= a * std::conj(gear.force_per_a) * share;
  clean.slack = share * (m * (std::norm(pinion.force_per_m) + std::norm(gear.force_per_m)) +
                         a * (std::norm(pinion.force_per_a) + std::norm(gear.force_per_a)));
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
      {{&ShaftKnown::mass_kg, &ShaftKnown::mass_ratio},
       {&ShaftKnown::damping_n_s_per_m, &ShaftKnown::damping_ratio},
       {&ShaftKnown::stiffness_n_per_m, &ShaftKnown::coupling_n, &ShaftKnown::tilt_stiffness_n_m,
        &ShaftKnown::stiffness_ratio},
       {&ShaftKnown::diametral_kg_m2},
       {&ShaftKnown::polar_kg_m2, &ShaftKnown::gyroscopic_ratio}}};
  return kCorrectable;
}

void Scale(ShaftKnown& shaft, const Numbers& numbers, double factor) {
  for (double ShaftKnown::*number : numbers) shaft.*number *= factor;
}

double SumSigma(const GearedLine& line, const GearedKnown& known, const GearedParameters& p) {
  const LineGains gains = GainsOn(line, known, p);
  const ShaftGains pinion = EitherGains(gains.pinion, known.pinion, line, p.pinion);
  const ShaftGains gear = EitherGains(gains.gear, known.gear, line, p.gear);
  const double stiff = std::hypot(std::abs(pinion.force_per_m), std::abs(gear.force_per_m));
  const double gain = std::hypot(std::abs(pinion.force_per_a), std::abs(gear.force_per_a));
  const double noise = std::hypot(stiff * line.sigma_m, gain * line.sigma_a);
  const double left = known.uncertainty > 0.0 ? kLeftOver : 0.0;
  const double model =
      std::hypot(KnownSigma(line, known, p, true, left), KnownSigma(line, known, p, false, left));
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
    const ForceTerms pinion = TermsOf(line, known, p, true);
    const ForceTerms gear = TermsOf(line, known, p, false);
    eq.Real(0, -pinion.by_ks);
    eq.Real(1, -pinion.by_ki);
    eq.Real(2, -gear.by_ks);
    eq.Real(3, -gear.by_ki);
    if (line.kind == Kind::kPinion) eq.ComplexAt(kUnbalance, w * w);
    if (line.kind == Kind::kGear) eq.ComplexAt(kUnbalance + 2, w * w);
    if (uncertain) AddCorrections(line, known, p, eq);
    eq.Close(pinion.rest + gear.rest + slack, SumSigma(line, known, p));
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
