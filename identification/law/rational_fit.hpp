#pragma once
// A rational transfer function from the spectra of an input and an output, by vector fitting.
//
// Equation  Y = (d + sum_i r_i/(zeta - p_i)) U + t_0 + sum_i t_i/(zeta - p_i) on the lines given;
//           the t_i stand for what the system holds at the first and last sample, so that no window
//           is needed and nothing leaks. Poles are moved to the zeros of sigma in
//           sigma Y = ... U + ..., sigma = 1 + sum_i c_i/(zeta - p_i), until they stay (Gustavsen
//           and Semlyen, IEEE Trans. Power Delivery 14(3), 1999); then Gauss-Newton on the squares
//           of Y less the fit: noise of Y, which stands beside sigma, shifts what the first finds.
// Domain    zeta = e^{jwT} of a law that runs at the rate of the record, or jw of an analogue one.
// Poles     real, or pairs of conjugates of which the one above the real axis is kept. Those that
//           grow are mirrored while they move, not at the end: a law that grows is shown as it is.
// Units     any; poles and residues in that of zeta.
// Thread    any; no shared state. Failure: none; too few lines for the order give an empty fit.

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace levitas::identification {

enum class LawDomain { kContinuous, kDiscrete };

/// One line of both spectra.
struct SpectrumLine {
  std::complex<double> zeta, input, output;
};

struct Pole {
  std::complex<double> place;    ///< imaginary part >= 0; above 0 it stands for two
  std::complex<double> residue;  ///< real of a real pole
  [[nodiscard]] std::size_t order() const noexcept { return place.imag() > 0.0 ? 2 : 1; }
};

struct RationalFit {
  std::vector<Pole> poles;
  double direct{};
  double squares{};  ///< sum of |Y - fit|^2 over the lines
  bool converged{};

  [[nodiscard]] std::size_t order() const noexcept;
  [[nodiscard]] std::complex<double> At(std::complex<double> zeta) const;
};

struct RationalFitOptions {
  LawDomain domain{};
  double lowest_rad_per_s{}, highest_rad_per_s{};  ///< between which poles are looked for at first
  double period_s{};                               ///< of a discrete law
  int turns{30};                                   ///< of the poles, at most
};

[[nodiscard]] RationalFit FitRational(std::span<const SpectrumLine> lines, std::size_t order,
                                      const RationalFitOptions& options);
/// The same from poles that are nearly right already.
[[nodiscard]] RationalFit FitRational(std::span<const SpectrumLine> lines,
                                      const std::vector<Pole>& begin,
                                      const RationalFitOptions& options);

}  // namespace levitas::identification
