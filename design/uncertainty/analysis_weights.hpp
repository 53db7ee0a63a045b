#pragma once
// What a controller is judged by: sizes of disturbance and noise, limits of current and position.
//
// Source     A. Sahinkaya & J. T. Sawicki (signal-based H-infinity of the flexible rotor):
//            disturbance per bearing 1.05 x the largest control current of their runs at 1600 to
//            6000 rpm, Chebyshev type II up to the top speed; noise 1 um; 1 A to 720 Hz, second
//            order; 0.7 um at rest (of 7 um: the static load is not in the disturbance), 36 um
//            from 0.1 Hz on.
// Chosen     order, attenuation and edge of the filter, which they do not print: 8, 40 dB, 140 Hz.
//            The edge matters: order 4 with an edge of 300 Hz costs 0.27 of mu.
// From       0.01 Hz: below, noise_m and position_rest_m contradict each other, since T(0) = 1
//            hands the noise on; no controller is below 1.43 at rest.
// Units      SI, in the names. Thread: pure.

#include <vector>

namespace levitas::uncertainty {

struct AnalysisWeights {
  std::vector<double> disturbance_a{0.2925, 0.2161};  ///< per bearing; beyond the list: the last
  int disturbance_order{8};
  double disturbance_attenuation_db{40.0};
  double disturbance_edge_hz{140.0};
  double noise_m{1e-6};
  double control_a{1.0};
  double control_hz{720.0};
  double position_rest_m{0.7e-6};
  double position_m{36e-6};
  double position_hz{0.1};
  double first_hz{0.01};
  double last_hz{4800.0};
};

[[nodiscard]] double DisturbanceA(const AnalysisWeights& weights, std::size_t bearing, double hz);
[[nodiscard]] double AllowedCurrentA(const AnalysisWeights& weights, double hz);
[[nodiscard]] double AllowedPositionM(const AnalysisWeights& weights, double hz);

}  // namespace levitas::uncertainty
