#pragma once
// How many bending modes a response shows, and where: poles of rational fits of growing order, and
// those among them that stay where they are.
//
// Equation  least-squares complex frequency estimator with a common denominator (Guillaume et al.
//           2003; Peeters et al. 2004): sum_r b_or W^r - H_o sum_r a_r W^r = 0 over the lines,
//           W = e^{j pi (f - low)/(high - low)} with complex coefficients, band after band
//           (1.4 times wide, with margins, so that a low order suffices), each response weighted by
//           1/sqrt(var + (|H|/10)^2); lowest coefficient a_0 = 1,
//           so that poles that only follow noise stay away from the unit circle.
// Stable    a pole whose frequency is within 0.5 % and whose damping within 0.005 of one of the
//           two orders before.
// Mode      stable at more than half of the orders that can hold it, damping below 0.02; or none of
//           these, but clear by itself (mode_scan.hpp).
// Thread    any; a second of work at most.

#include <cstddef>
#include <vector>

#include "identification/frf/frequency_response.hpp"

namespace levitas::identification {

struct OrderPole {
  std::size_t order{};
  double frequency_hz{};
  double damping_ratio{};
  bool stable{};
};

struct ProposedMode {
  double frequency_hz{};  ///< of the plant, magnets' negative stiffness included
  double damping_ratio{};
  double share{};     ///< of the orders at which it was stable
  double evidence{};  ///< of the scan; 0 where it saw none
};

struct Stabilisation {
  std::vector<OrderPole> poles;
  std::vector<ProposedMode> modes;  ///< ascending
};

struct StabilisationOptions {
  double lowest_hz{20.0};  ///< bending modes are looked for from here on
  double highest_hz{1200.0};
  std::size_t highest_order{20};
};

[[nodiscard]] Stabilisation Stabilise(const FrequencyResponse& response,
                                      const StabilisationOptions& options);

/// Highest frequency up to which the response stands out of its noise: beyond it no channel has
/// twice the noise's amplitude in the median of a tenth of an octave.
[[nodiscard]] double UsableBandHz(const FrequencyResponse& response);

}  // namespace levitas::identification
