#pragma once
// What a decentralised law makes of one plant: stability, peaks, damping, noise.
//
// Stable    by counting: the argument of det(I + P C) prod(1 - z^-1), integrators taken out, turns
//           by pi (growing poles of the plant - growing poles of the loop) from z = 1 to -1. Where
//           it turns by more than kTurn between neighbours, points are put between them until it
//           does not: a resonance however narrow is met or lies within kNarrowest.
// Peaks     of |S_ii|, |T_ii|, |C_i S_ii|, |(S P)_ii|/ki, and the largest singular value of S: the
//           same points, read off as in survey_samples.hpp.
// Damping   of every pole of the loop near the axis: Newton's iteration s - 1/x from the minima of
//           the determinant, x the largest eigenvalue of M^-1 dM/ds, M = I + P C, so that poles in
//           pairs are told apart; and, for modes that the law hardly moves, to first order.
// Noise     white at the sensors, its whole power between 0 and half the sampling rate: current
//           and motion it makes, by the trapezoid rule.
// Channels  of a plant with coordinates: one law each; peaks, noise and compliance are those of the
//           axes all the same, S = M^-1 S' M, C S = R C' S' M.
// Thread    any; pure.

#include <vector>

#include "controller/law/discrete_law.hpp"
#include "design/pid/sampled_plant.hpp"

namespace levitas::design {

struct PeakAt {
  double value{}, hz{};
};

struct LoopSurvey {
  int growing{};  ///< poles of the loop outside the unit circle
  PeakAt sensitivity, complementary, current_per_metre, singular;
  PeakAt metre_per_newton;  ///< |(S P)_ii| over the axis' ki: what a force at its magnet moves
  PeakAt damping;           ///< the least of an oscillating pole, and its frequency
  std::vector<double> current_a;   ///< rms, per axis, of noise
  std::vector<double> position_m;  ///< the same
};

/// Laws as they run, one per axis or channel. `noise_m`: rms of each sensor.
[[nodiscard]] LoopSurvey Survey(const SampledPlant& plant,
                                const std::vector<law::DiscreteLaw>& laws,
                                const std::vector<double>& noise_m);

/// C(z) (1 - z^-1 where it integrates).
struct LawValue {
  std::complex<double> value;
  bool integrates{};
};
[[nodiscard]] LawValue ValueAt(const law::DiscreteLaw& law, std::complex<double> q);

/// C(z) between the axes, of laws of the axes or of the channels of the coordinates; not at z = 1
/// where one integrates.
[[nodiscard]] AxisMatrix ControllerAt(const std::vector<law::DiscreteLaw>& laws,
                                      std::complex<double> q, const Coordinates& coordinates);

}  // namespace levitas::design
