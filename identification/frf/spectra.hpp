#pragma once
// What one experiment says on each of its lines, period by period.
//
// Periodic  lines are the multiples of 1/period: discrete Fourier transforms of whole periods.
// Stepped   a line is a sine that was held: of its second part, where the transient is over, whole
//           periods of the sine in up to eight blocks; least squares in each.
// Removed   the mean, and what turns with the rotor (synchronous.hpp); `near_order` marks the lines
//           that lie too close to an order to be told from it.
// Units     complex amplitudes, any common scale: only ratios to `excitation` count.
// Thread    any.

#include <complex>
#include <vector>

#include "identification/frf/experiments.hpp"

namespace levitas::identification {

using Spectrum = std::vector<std::complex<double>>;

struct Spectra {
  std::size_t axis{};
  SummingPoint point{};
  std::size_t periods{};  ///< of a stepped sine: blocks of every line
  std::vector<double> frequency_hz;
  std::vector<bool> near_order;
  /// Lines to either side over which noise is taken as equally strong.
  std::ptrdiff_t neighbours{};
  std::vector<std::vector<Spectrum>> position, current;  ///< [channel][period][line]
  Spectrum excitation;
};

/// `orders` of rotation are removed; 0 with a rotor that stands.
[[nodiscard]] Spectra SpectraOf(const session::Recording& record, const Experiment& experiment,
                                int orders);

}  // namespace levitas::identification
