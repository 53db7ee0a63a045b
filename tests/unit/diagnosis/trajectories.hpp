#pragma once
// Runs of a model whose innovations are made by hand: white noise, and what is added to it.

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "diagnosis/model/model_run.hpp"
#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {

inline constexpr double kNoise = 1e-6;  // [m] rms

/// Currents and positions are noise of their own. `shape` may change each moment after its noise
/// was drawn: sample number and moment.
inline Trajectory NoiseRun(std::uint64_t seed, std::size_t samples,
                           const std::function<void(std::size_t, SamplePoint&)>& shape = {}) {
  Random random(seed);
  Trajectory run;
  run.moments.resize(samples);
  for (std::size_t n = 0; n < samples; ++n) {
    SamplePoint& m = run.moments[n];
    m.settled = m.counts = true;
    m.time_s = static_cast<double>(n) * TheRig().period_s;
    for (std::size_t a = 0; a < TheRig().axes; ++a) {
      m.innovation_m[a] = static_cast<float>(kNoise * random.Normal());
      m.command_now_a[a] = static_cast<float>(0.1 * random.Normal());
      m.reading_m[a] = static_cast<float>(5e-6 * random.Normal());
      m.measured_m[a] = static_cast<float>(20e-6 * std::sin(0.01 * static_cast<double>(n)));
    }
    if (shape) shape(n, m);
  }
  return run;
}

inline double Sine(double amplitude, double hz, double time_s) {
  return amplitude * std::sin(2.0 * std::numbers::pi * hz * time_s);
}

}  // namespace levitas::diagnosis
