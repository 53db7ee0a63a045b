#pragma once
// The axis law in discrete time, as numbers: what axis_law.hpp executes and analysis reads.
//
// Equation   s -> (2/T)(z-1)/(z+1) (Tustin) in each block of law_config.hpp, without prewarp, but
//            s -> w/tan(wT/2) (z-1)/(z+1) in a notch at w with prewarp; see docs/derivations.md
//            eq. (L1)-(L8). Written in q = z^-1:
//              PID      Kp + g (1+q)/(1-q) + b (1-q)/(1+a q)
//              section  (b0 + b1 q + b2 q^2) / (1 + a1 q + a2 q^2)
// Units      input metres, output amperes; frequencies in Hz.
// Thread     any; not for the control cycle (allocates).
// Failure    std::invalid_argument naming the parameter that makes the block impossible.
// Not done   no sign: C is the positive transfer function, the caller closes ic = -C(y - ref).

#include <complex>
#include <vector>

#include "controller/law/law_config.hpp"

namespace levitas::law {

/// One first- or second-order filter, normalised to a0 = 1. First order: b2 = a2 = 0.
struct Section {
  double b0{1.0}, b1{}, b2{}, a1{}, a2{};
};

/// PID with filtered derivative, in parallel form.
struct DiscretePid {
  double proportional_a_per_m{};
  double integral_a_per_m{};    ///< g = Ki T / 2
  double derivative_a_per_m{};  ///< b = Kd (2/T) / (1 + r),  r = 2 / (T wd)
  double derivative_pole{};     ///< a = (1 - r) / (1 + r); 0 without derivative
};

struct DiscreteLaw {
  DiscretePid pid;
  std::vector<Section> lead_lags;  ///< first order
  std::vector<Section> notches;    ///< second order
};

/// Where a notch given at frequency_hz stands in discrete time [Hz]: there with prewarp, below it
/// without, atan(w T/2)/(pi T).
[[nodiscard]] double StandsAt(const Notch& notch, double period_s);

[[nodiscard]] DiscreteLaw Discretise(const AxisLawConfig& config, double period_s);

/// The whole law as a cascade: PID first (without the pole at z = 1 when Ki = 0 and without the
/// derivative's pole when Kd = 0), then lead-lags, then notches.
[[nodiscard]] std::vector<Section> DiscreteSections(const AxisLawConfig& config, double period_s);

/// C(e^{jwT}) of the discrete law [A/m]. Infinite at 0 Hz when Ki > 0.
[[nodiscard]] std::complex<double> FrequencyResponse(const DiscreteLaw& law, double frequency_hz,
                                                     double period_s);

/// C(s) of the continuous law [A/m], s in rad/s.
[[nodiscard]] std::complex<double> ContinuousResponse(const AxisLawConfig& config,
                                                      std::complex<double> s);

/// The discrete law at frequency f equals C(jw) exactly at this angular frequency [rad/s].
[[nodiscard]] double TustinWarp(double frequency_hz, double period_s);

}  // namespace levitas::law
