#pragma once
// Averaged power spectrum of a sampled signal (Welch 1967: Hann window, half overlap).
//
// Units     one-sided density [unit^2/Hz]: its sum times the line spacing is the mean square.
// Gaps      segments never span two pieces: add each uninterrupted piece by itself.
// Thread    any; not for the control cycle.

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace levitas::analysis {

class Welch {
 public:
  /// `segment` samples per segment, a power of two of at least 8 (std::invalid_argument else).
  Welch(std::size_t segment, double sample_rate_hz);

  /// Pieces shorter than a segment add nothing.
  void Add(std::span<const double> piece);

  [[nodiscard]] std::size_t averages() const noexcept { return averages_; }
  [[nodiscard]] double line_spacing_hz() const noexcept;
  /// segment/2 + 1 densities, from 0 Hz to half the sampling rate; zeros before anything was added.
  [[nodiscard]] std::vector<double> Density() const;

 private:
  void AddSegment(std::span<const double> samples);

  double sample_rate_hz_;
  std::vector<double> window_;
  std::vector<double> sum_;
  std::size_t averages_{0};
};

/// Magnitude-squared coherence of two signals, line by line: how much of one follows the other.
class Coherence {
 public:
  /// As Welch.
  explicit Coherence(std::size_t segment);

  /// Both pieces have the same length (std::invalid_argument else).
  void Add(std::span<const double> first, std::span<const double> second);

  /// What two unrelated signals show on average; 1 before anything was added.
  [[nodiscard]] double Chance() const noexcept;
  /// segment/2 + 1 values from 0 to 1.
  [[nodiscard]] std::vector<double> Squared() const;

 private:
  std::vector<double> window_;
  std::vector<double> first_, second_;
  std::vector<std::complex<double>> cross_;
  std::size_t averages_{0};
};

}  // namespace levitas::analysis
