#include "analysis/records/spectrum.hpp"

#include <algorithm>
#include <bit>
#include <complex>
#include <stdexcept>

#include "numerics/fourier_transform.hpp"
#include "numerics/hann_window.hpp"

namespace levitas::analysis {
namespace {

using Complex = std::complex<double>;

std::vector<double> HannWindow(std::size_t segment) {
  if (segment < 8 || !std::has_single_bit(segment)) {
    throw std::invalid_argument("a spectrum's segment must be a power of two of at least 8");
  }
  std::vector<double> window(segment);
  for (std::size_t i = 0; i < segment; ++i) window[i] = numerics::HannWeight(i, segment);
  return window;
}

}  // namespace

Welch::Welch(std::size_t segment, double sample_rate_hz)
    : sample_rate_hz_(sample_rate_hz), window_(HannWindow(segment)), sum_(segment / 2 + 1, 0.0) {}

double Welch::line_spacing_hz() const noexcept {
  return sample_rate_hz_ / static_cast<double>(window_.size());
}

void Welch::Add(std::span<const double> piece) {
  const std::size_t segment = window_.size();
  for (std::size_t start = 0; start + segment <= piece.size(); start += segment / 2) {
    AddSegment(piece.subspan(start, segment));
  }
}

void Welch::AddSegment(std::span<const double> samples) {
  std::vector<double> windowed(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) windowed[i] = samples[i] * window_[i];
  const std::vector<Complex> lines = numerics::HalfSpectrum(windowed);
  for (std::size_t line = 0; line < sum_.size(); ++line) sum_[line] += std::norm(lines[line]);
  ++averages_;
}

std::vector<double> Welch::Density() const {
  std::vector<double> density(sum_.size(), 0.0);
  if (averages_ == 0) return density;
  double window_power = 0.0;
  for (const double w : window_) window_power += w * w;
  const double scale = 1.0 / (static_cast<double>(averages_) * sample_rate_hz_ * window_power);
  for (std::size_t line = 0; line < sum_.size(); ++line) {
    // Both signs of the frequency count, except at the two ends, which have only one.
    const bool end = line == 0 || line + 1 == sum_.size();
    density[line] = sum_[line] * scale * (end ? 1.0 : 2.0);
  }
  return density;
}

Coherence::Coherence(std::size_t segment)
    : window_(HannWindow(segment)),
      first_(segment / 2 + 1, 0.0),
      second_(first_),
      cross_(first_.size()) {}

void Coherence::Add(std::span<const double> first, std::span<const double> second) {
  if (first.size() != second.size()) {
    throw std::invalid_argument("coherence: the two signals differ in length");
  }
  const std::size_t segment = window_.size();
  std::vector<Complex> both(segment);
  for (std::size_t start = 0; start + segment <= first.size(); start += segment / 2) {
    // Two real signals in one transform: the even part is the first, the odd part the second.
    for (std::size_t i = 0; i < segment; ++i) {
      both[i] = window_[i] * Complex(first[start + i], second[start + i]);
    }
    numerics::FourierTransform(both);
    for (std::size_t line = 0; line < cross_.size(); ++line) {
      const Complex mirrored = std::conj(both[(segment - line) % segment]);
      const Complex one = 0.5 * (both[line] + mirrored);
      const Complex two = Complex(0.0, -0.5) * (both[line] - mirrored);
      first_[line] += std::norm(one);
      second_[line] += std::norm(two);
      cross_[line] += one * std::conj(two);
    }
    ++averages_;
  }
}

double Coherence::Chance() const noexcept {
  // Half-overlapping Hann segments share a sixth of their amplitude: 1 + 2/36 times as many are
  // needed as independent ones (Welch 1967).
  return averages_ == 0 ? 1.0 : std::min(1.0, (1.0 + 2.0 / 36.0) / static_cast<double>(averages_));
}

std::vector<double> Coherence::Squared() const {
  std::vector<double> squared(cross_.size(), 0.0);
  for (std::size_t line = 0; line < squared.size(); ++line) {
    const double powers = first_[line] * second_[line];
    if (powers > 0.0) squared[line] = std::norm(cross_[line]) / powers;
  }
  return squared;
}

}  // namespace levitas::analysis
