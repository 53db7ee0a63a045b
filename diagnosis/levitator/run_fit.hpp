#pragma once
// How well a model predicts a record: free-running coil currents, and the ball's motion.
//
// Current    fit of the upper coil, 100 % (1 - |measured - predicted|/|measured - mean|), in free
//            run from the commanded voltage and the measured position. The lower coil's too where
//            it moves.
// Motion     fit of the one-step prediction with the fixed observer (motion_run.hpp), as in
//            diagnosis/inference/gain.hpp: a force that is wrong stays in it as an offset.
// Ceiling    the fit that white noise alone would leave, of the power that what is left has near
//            half the sampling rate, where coil and ball follow nothing.
// Interval   5 to 95 % of a block bootstrap over blocks of half a second (Kuensch 1989), written
//            seed.
// Thread     any; pure.

#include "diagnosis/levitator/motion_run.hpp"

namespace levitas::levitator {

/// A fit in percent with its interval.
struct Fit {
  double percent{}, low{}, high{};
};

struct RunFit {
  Fit current, away, motion;  ///< of the upper coil, the lower coil, the ball
};

/// Residual of a record at the evaluated rows.
struct Errors {
  std::array<std::vector<double>, 2> current_a, measured_a;
  std::vector<double> motion_m, position_m;
};

[[nodiscard]] Errors ErrorsOf(const NominalRig& rig, const Series& series, const Theta& theta,
                              std::size_t record);
[[nodiscard]] RunFit FitOf(const Errors& errors, double period_s);

/// Standard deviation of the white part of a signal, from its fourth differences.
[[nodiscard]] double WhiteNoise(const std::vector<double>& signal);
/// The fit to `measured` of a model that leaves `noise` alone.
[[nodiscard]] double Ceiling(const std::vector<double>& measured, double noise);

/// Of the squared error that a better model could take away, the share that `after` has taken from
/// `before`, both beyond `noise`; with its interval.
[[nodiscard]] Fit SharePercent(const std::vector<double>& before, const std::vector<double>& after,
                               double noise, double period_s);

}  // namespace levitas::levitator
