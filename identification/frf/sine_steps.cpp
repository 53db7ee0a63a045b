#include "identification/frf/sine_steps.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "common/two_pi.hpp"

namespace levitas::identification {
namespace {

constexpr double kTolerance = 1e-3;
constexpr int kRefinements = 3;
/// Neighbours closer than this are one sine whose amplitude was cut back.
constexpr double kSameSine = 1e-3;

/// Samples from `begin` to the second change of sign after it: between half a period and one.
std::optional<std::size_t> ToSecondCrossing(std::span<const double> x, std::size_t begin) {
  std::size_t crossings = 0;
  for (std::size_t n = begin + 1; n < x.size(); ++n) {
    if ((x[n] >= 0.0) == (x[n - 1] >= 0.0)) continue;
    if (++crossings == 2) return n - begin;
  }
  return std::nullopt;
}

/// 2 cos(2 pi f k) by least squares over samples [from, to).
double Recurrence(std::span<const double> x, std::size_t k, std::size_t from, std::size_t to) {
  double product = 0.0;
  double square = 0.0;
  for (std::size_t n = from; n < to; ++n) {
    product += x[n] * (x[n + k] + x[n - k]);
    square += x[n] * x[n];
  }
  return square > 0.0 ? product / square : 0.0;
}

/// Frequency by Gauss-Newton on amplitude, phase and frequency over all samples of the step.
void Refine(std::span<const double> x, SineStep& step) {
  const auto piece = x.subspan(step.begin, step.end - step.begin);
  for (int i = 0; i < kRefinements; ++i) {
    step.amplitude = SineAmplitude(piece, step.cycles_per_sample, 0);
    double product = 0.0;
    double square = 0.0;
    // Slope by f beside that by the phase: the time counts from the middle.
    const double middle = 0.5 * static_cast<double>(piece.size() - 1);
    for (std::size_t n = 0; n < piece.size(); ++n) {
      const double t = static_cast<double>(n);
      const auto turn = step.amplitude * std::polar(1.0, kTwoPi * step.cycles_per_sample * t);
      const double slope = -kTwoPi * (t - middle) * turn.imag();
      product += slope * (piece[n] - turn.real());
      square += slope * slope;
    }
    if (square > 0.0) step.cycles_per_sample += product / square;
  }
  step.amplitude = SineAmplitude(piece, step.cycles_per_sample, 0);
}

std::optional<SineStep> StepFrom(std::span<const double> x, std::size_t begin, double largest) {
  const auto crossing = ToSecondCrossing(x, begin);
  if (!crossing) return std::nullopt;
  // A quarter of the period is between a quarter and half of that.
  const std::size_t k = std::max<std::size_t>(1, *crossing / 3);
  const std::size_t first = begin + k;
  const std::size_t probe_end = first + std::max<std::size_t>(*crossing, 3);
  if (probe_end + k > x.size()) return std::nullopt;
  const double twice_cosine = Recurrence(x, k, first, probe_end);
  if (!(std::abs(twice_cosine) < 2.0)) return std::nullopt;
  std::size_t n = first;
  while (n + k < x.size() &&
         std::abs(x[n + k] + x[n - k] - twice_cosine * x[n]) < kTolerance * largest) {
    ++n;
  }
  if (n < probe_end) return std::nullopt;
  SineStep step{
      begin, n + k, std::acos(0.5 * twice_cosine) / (kTwoPi * static_cast<double>(k)), {}};
  Refine(x, step);
  return step;
}

}  // namespace

std::complex<double> SineAmplitude(std::span<const double> signal, double cycles_per_sample,
                                   std::size_t offset) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < signal.size(); ++n) {
    const double angle = kTwoPi * cycles_per_sample * static_cast<double>(n + offset);
    const Eigen::Vector3d basis(1.0, std::cos(angle), std::sin(angle));
    normal += basis * basis.transpose();
    right += signal[n] * basis;
  }
  const Eigen::Vector3d found = normal.ldlt().solve(right);
  return {found[1], -found[2]};
}

std::vector<SineStep> FindSineSteps(std::span<const double> signal) {
  double largest = 0.0;
  for (const double value : signal) largest = std::max(largest, std::abs(value));
  std::vector<SineStep> steps;
  for (std::size_t begin = 0; begin < signal.size();) {
    const auto step = StepFrom(signal, begin, largest);
    if (!step) {
      // What is left of the last step after its last sample may be a remainder of a new one.
      const bool remainder =
          !steps.empty() && signal.size() - begin < (steps[0].end - steps[0].begin);
      return remainder ? steps : std::vector<SineStep>{};
    }
    if (!steps.empty() &&
        std::abs(step->cycles_per_sample / steps.back().cycles_per_sample - 1.0) < kSameSine) {
      return {};
    }
    steps.push_back(*step);
    begin = step->end;
  }
  return steps;
}

}  // namespace levitas::identification
