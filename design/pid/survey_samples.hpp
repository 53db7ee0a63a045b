#pragma once
// Samples of a loop over frequency, and what is read off them.
//
// Peak      largest sample, or top of the parabola of 1/value^2 through the three around a maximum,
//           which is exact for one resonance.
// Noise     trapezoid rule over the samples, white noise spread evenly to the last of them.
// Turn      of the determinant from one sample to the next, in -pi to pi.
// Thread    any; pure.

#include <array>
#include <complex>
#include <vector>

#include "common/axes.hpp"
#include "design/pid/loop_survey.hpp"

namespace levitas::design {

/// One frequency of the loop.
struct Sample {
  double hz{};
  std::complex<double> determinant;
  double sensitivity{}, complementary{}, current_per_metre{}, metre_per_newton{}, frobenius{};
  std::array<double, kMaxAxes> current{}, position{};  ///< squares of rows of C S and of T
};

[[nodiscard]] double Turn(const Sample& from, const Sample& to);
/// Sum over all samples.
[[nodiscard]] double Turned(const std::vector<Sample>& samples);
[[nodiscard]] PeakAt LargestOf(const std::vector<Sample>& samples, double Sample::*of);
/// rms of current and position of each axis.
void AddNoise(const std::vector<Sample>& samples, std::size_t axes, LoopSurvey& out);

}  // namespace levitas::design
