#pragma once
// The shipped levitator, and records made of a few lines, for the tests of its diagnosis.

#include <cmath>
#include <cstddef>

#include "common/random.hpp"
#include "configuration/rig_file.hpp"
#include "diagnosis/levitator/misfit.hpp"

namespace levitas::test {

inline configuration::RigFile LevitatorFile() {
  return configuration::LoadRig(configuration::FindConfig("two_magnet_levitator", "rigs"));
}

/// Rows of 1 ms: the same duty and place throughout, currents as given.
inline levitator::Series StillSeries(std::size_t rows, double asked_a, double current_a,
                                     double position_m = 0.0) {
  levitator::Series series;
  series.name = "still";
  for (std::size_t n = 0; n < rows; ++n) {
    series.time_s.push_back(1e-3 * static_cast<double>(n));
    series.asked_a[0].push_back(asked_a);
    series.asked_a[1].push_back(0.0);
    series.measured_a[0].push_back(current_a);
    series.measured_a[1].push_back(0.0243);
    series.position_m.push_back(position_m);
    series.restart.push_back(n == 0);
    series.counts.push_back(n >= 100);
  }
  series.idle = {false, true};
  return series;
}

/// Current of the upper coil that carries the ball of the rig file at x.
inline double CarryingCurrent(const levitator::NominalRig& rig, double x_m) {
  const double per_square = rig.force_n_per_a2 * std::exp((x_m - rig.gap_m) / rig.force_decay_m);
  return std::sqrt(rig.mass_kg * rig.gravity_m_per_s2 / per_square);
}

/// Duty that jumps at random, currents of the model itself at `truth` with 5 mA of noise.
inline levitator::Series LivelySeries(const levitator::NominalRig& rig,
                                      const levitator::Theta& truth, std::size_t rows,
                                      std::uint64_t seed) {
  Random random(seed);
  levitator::Series series = StillSeries(rows, 1.0, 1.0);
  for (std::size_t n = 0; n < rows; ++n) {
    series.asked_a[0][n] =
        n % 25 == 0 || n == 0 ? 0.7 + 0.7 * random.Uniform() : series.asked_a[0][n - 1];
    series.position_m[n] = 1e-3 * std::sin(0.02 * static_cast<double>(n));
  }
  const levitator::CoilRun run = levitator::RunCoils(rig, series, truth, 0);
  for (std::size_t coil = 0; coil < 2; ++coil) {
    for (std::size_t n = 0; n < rows; ++n) {
      series.measured_a[coil][n] = run.reading_a[coil][n] + 5e-3 * random.Normal();
    }
  }
  return series;
}

}  // namespace levitas::test
