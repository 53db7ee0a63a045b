#pragma once
// Parameters of the decentralised axis law.
//
//   C(s) = [Kp + Ki/s + Kd s/(1 + s/wd)] . (1 + s/wz)/(1 + s/wp) . N1(s) . N2(s) ...
//   N(s) = (s^2/w^2 + 2 zz s/w + 1) / (s^2/w^2 + 2 zp s/w + 1)
//   ic   = -C(s) (y - reference)
// Source: M. N. Sahinkaya & J. T. Sawicki, flexible rotor on two AMBs; docs/derivations_law.md.

#include <vector>

namespace levitas::law {

struct LeadLag {
  double zero_hz{};
  double pole_hz{};
};

struct Notch {
  double frequency_hz{};
  double zero_damping{};  ///< [1] damping ratio of the numerator
  double pole_damping{};  ///< [1] damping ratio of the denominator
};

struct AxisLawConfig {
  double kp_a_per_m{};
  double ki_a_per_m_s{};
  double kd_a_s_per_m{};
  double derivative_hz{};  ///< corner of the derivative filter, wd / 2 pi
  std::vector<LeadLag> lead_lags;
  std::vector<Notch> notches;
};

/// One entry per axis of the rig.
struct LawConfig {
  std::vector<AxisLawConfig> axes;
  double period_s{};
  double current_limit_a{};  ///< |ic| <= this: min(i0, i_max - i0) keeps both coils in range
};

}  // namespace levitas::law
