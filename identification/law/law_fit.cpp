#include "identification/law/law_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/problem.hpp"
#include "common/two_pi.hpp"
#include "numerics/fourier_transform.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;

constexpr Eigen::Index kLeastRows = 200;
/// Lines on which orders are compared; the chosen one is fitted on all.
constexpr std::size_t kSearchLines = 4000;
constexpr double kRounding = 1e-9;
/// Orders beyond the best one that are tried without a better one.
constexpr std::size_t kBeyond = 3;

/// The longest length not above `rows` whose factors are 2, 3 and 5: others transform slowly.
Eigen::Index QuickLength(Eigen::Index rows) {
  for (Eigen::Index length = rows;; --length) {
    Eigen::Index rest = length;
    for (const Eigen::Index factor : {2, 3, 5})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return length;
  }
}

void RefuseUnfit(const LawSignals& signals) {
  if (signals.input.size() < kLeastRows) {
    throw BadInput(
        fmt::format("{}: {} rows, needed are {}", signals.name, signals.input.size(), kLeastRows));
  }
  for (const auto* column : {&signals.input, &signals.output}) {
    const char* which = column == &signals.input ? "input" : "output";
    if (!column->allFinite()) {
      throw BadInput(fmt::format("{}: the {} has values that are no numbers", signals.name, which));
    }
    if (column->maxCoeff() == column->minCoeff()) {
      throw BadInput(fmt::format("{}: the {} never changes", signals.name, which));
    }
  }
}

std::vector<SpectrumLine> LinesOf(const LawSignals& signals, LawFitOptions& options) {
  const Eigen::Index rows = QuickLength(signals.input.size());
  const double spacing_hz = 1.0 / (static_cast<double>(rows) * options.period_s);
  const double rate_hz = 1.0 / options.period_s;
  const bool discrete = options.domain == LawDomain::kDiscrete;
  if (options.lowest_hz <= 0.0) options.lowest_hz = 2.0 * spacing_hz;
  if (options.highest_hz <= 0.0) options.highest_hz = (discrete ? 0.5 : 0.4) * rate_hz;
  const auto transform = [rows](const Eigen::VectorXd& column) {
    return numerics::HalfSpectrum({column.data(), static_cast<std::size_t>(rows)});
  };
  const auto input = transform(signals.input);
  const auto output = transform(signals.output);
  std::vector<SpectrumLine> lines;
  for (std::size_t k = 1; k + 1 < input.size(); ++k) {
    const double f = static_cast<double>(k) * spacing_hz;
    if (f < options.lowest_hz || f > options.highest_hz) continue;
    const Complex jw(0.0, kTwoPi * f);
    lines.push_back({discrete ? std::exp(jw * options.period_s) : jw, input[k], output[k]});
  }
  if (lines.size() < 20) {
    throw BadInput(
        fmt::format("{}: {} lines between {:.4g} and {:.4g} Hz, needed are 20; record "
                    "longer or widen the band",
                    signals.name, lines.size(), options.lowest_hz, options.highest_hz));
  }
  return lines;
}

double SquaresOf(const std::vector<SpectrumLine>& lines) {
  double sum = 0.0;
  for (const SpectrumLine& line : lines) sum += std::norm(line.output);
  return sum;
}

double FitPercent(double squares, double all) { return 100.0 * (1.0 - std::sqrt(squares / all)); }

/// Spread evenly over the logarithm of the line's number: low poles have few lines.
std::vector<SpectrumLine> Thinned(const std::vector<SpectrumLine>& lines) {
  if (lines.size() <= kSearchLines) return lines;
  std::vector<SpectrumLine> few;
  const double step = std::pow(static_cast<double>(lines.size()), 1.0 / kSearchLines);
  double next = 0.0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (static_cast<double>(k) < next) continue;
    few.push_back(lines[k]);
    next = std::max(static_cast<double>(k) + 1.0, static_cast<double>(k) * step);
  }
  return few;
}

RationalFitOptions HowOf(const LawFitOptions& options) {
  return {.domain = options.domain,
          .lowest_rad_per_s = kTwoPi * options.lowest_hz,
          .highest_rad_per_s = kTwoPi * options.highest_hz,
          .period_s = options.period_s};
}

/// The order that the criterion chooses, fitted on the few lines; all that were tried into `tried`.
RationalFit Choose(const std::vector<SpectrumLine>& few, const LawFitOptions& options,
                   std::vector<OrderTried>& tried) {
  const double all = SquaresOf(few);
  const auto count = static_cast<double>(2 * few.size());
  const std::size_t first = options.order.value_or(0);
  const std::size_t last = options.order.value_or(options.most_order);
  RationalFit best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t order = first; order <= last; ++order) {
    if (order > best.order() + kBeyond && std::isfinite(least)) break;
    RationalFit fit = FitRational(few, order, HowOf(options));
    if (fit.order() != order) continue;
    const double floor = kRounding * kRounding * all;
    const double criterion = count * std::log((fit.squares + floor) / count) +
                             static_cast<double>(2 * order + 1) * std::log(count);
    tried.push_back({order, FitPercent(fit.squares, all), criterion});
    if (criterion >= least) continue;
    least = criterion;
    best = std::move(fit);
  }
  return best;
}

/// Cross spectrum over input power in bands of a fiftieth of an octave.
void Average(const std::vector<SpectrumLine>& lines, double period_s, LawFit& fit) {
  const double wide = std::exp2(1.0 / 50.0);
  const auto hz = [&](const SpectrumLine& line) {
    return fit.options.domain == LawDomain::kDiscrete ? std::arg(line.zeta) / (kTwoPi * period_s)
                                                      : line.zeta.imag() / kTwoPi;
  };
  for (std::size_t first = 0; first < lines.size();) {
    Complex cross = 0.0;
    double power = 0.0;
    double sum_hz = 0.0;
    std::size_t last = first;
    for (; last < lines.size() && hz(lines[last]) <= wide * hz(lines[first]); ++last) {
      cross += lines[last].output * std::conj(lines[last].input);
      power += std::norm(lines[last].input);
      sum_hz += hz(lines[last]);
    }
    fit.measured_hz.push_back(sum_hz / static_cast<double>(last - first));
    fit.measured.push_back(cross / power);
    first = last;
  }
}

}  // namespace

Complex LawFit::At(double frequency_hz) const {
  const Complex jw(0.0, kTwoPi * frequency_hz);
  return law.At(options.domain == LawDomain::kDiscrete ? std::exp(jw * options.period_s) : jw);
}

LawFit FitLaw(const LawSignals& signals, const LawFitOptions& options) {
  RefuseUnfit(signals);
  LawFit fit;
  fit.name = signals.name;
  fit.options = options;
  const std::vector<SpectrumLine> lines = LinesOf(signals, fit.options);
  const RationalFit chosen = Choose(Thinned(lines), fit.options, fit.tried);
  fit.law = FitRational(lines, chosen.poles, HowOf(fit.options));
  fit.lines = lines.size();
  fit.fit_percent = FitPercent(fit.law.squares, SquaresOf(lines));
  Average(lines, fit.options.period_s, fit);
  return fit;
}

void AddToLaw(const LawFit& fit, std::size_t axis, double output_per_input,
              law::StateSpaceConfig& law) {
  law.direct[axis][axis] = output_per_input * fit.law.direct;
  for (const Pole& pole : fit.law.poles) {
    law::ModalBlock block;
    block.pole_real = pole.place.real();
    const Complex residue = output_per_input * pole.residue;
    if (!(std::abs(residue) > 0.0)) continue;
    if (pole.order() == 1) {
      const double size = std::sqrt(std::abs(residue));
      block.first_input[axis] = size;
      block.first_output[axis] = residue.real() / size;
    } else {
      // w = first + j second obeys w' = conj(p) w + b v; the output is c1 Re w + c2 Im w. With a
      // real b that is r/(zeta - p) and its conjugate for c1 - j c2 = 2 conj(r)/b.
      const double size = std::sqrt(2.0 * std::abs(residue));
      block.pole_imaginary = pole.place.imag();
      block.first_input[axis] = size;
      block.first_output[axis] = 2.0 * residue.real() / size;
      block.second_output[axis] = 2.0 * residue.imag() / size;
    }
    law.blocks.push_back(block);
  }
}

}  // namespace levitas::identification
