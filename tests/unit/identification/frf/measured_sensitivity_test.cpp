#include "identification/frf/measured_sensitivity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace levitas::identification {
namespace {

using testing::HasSubstr;

constexpr double kPeakHz = 100.0;

/// One axis with |S| = 1 far from a resonance at 100 Hz that makes it `peak`, `damping` wide.
FrequencyResponse Resonance(double peak, double damping, double spacing_hz, double sigma) {
  FrequencyResponse r;
  r.channels = {"x"};
  for (double f = spacing_hz; f <= 1000.0; f += spacing_hz) {
    const std::complex<double> s{0.0, f / kPeakHz};
    const std::complex<double> wide = 2.0 * damping * s;
    r.frequency_hz.push_back(f);
    r.sensitivity.emplace_back(
        Eigen::MatrixXcd::Constant(1, 1, (s * s + peak * wide + 1.0) / (s * s + wide + 1.0)));
    r.own_variance.emplace_back(Eigen::VectorXd::Constant(1, sigma * sigma));
  }
  return r;
}

TEST(MeasuredPeaks, GradesThePeakOfClearLines) {
  const auto peaks = MeasuredPeaks(Resonance(3.5, 0.2, 1.0, 0.02));
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_EQ(peaks[0].refused, "");
  EXPECT_NEAR(peaks[0].line_peak, 3.5, 1e-9);  // a line stands on the top, where S is 3.5 exactly
  EXPECT_EQ(peaks[0].line_sigma, 0.02);
  // A parabola may miss the top by two deviations of what it is compared with.
  EXPECT_NEAR(peaks[0].peak, 3.5, 0.04);
  EXPECT_LT(peaks[0].sigma, 0.02);
  EXPECT_NEAR(peaks[0].frequency_hz, kPeakHz, 5.0);
  EXPECT_EQ(peaks[0].spacing_hz, 1.0);
  EXPECT_EQ(peaks[0].zone, analysis::Zone::kB);
}

TEST(MeasuredPeaks, GivesNoZoneToNoise) {
  // A sigma of 0.3 is more than a tenth of |S| = 1 on nearly all lines.
  const auto peaks = MeasuredPeaks(Resonance(3.5, 0.2, 1.0, 0.3));
  EXPECT_FALSE(peaks[0].zone.has_value());
  EXPECT_THAT(peaks[0].refused, HasSubstr("clear of noise"));
}

TEST(MeasuredPeaks, GivesNoZoneToAPeakThatFallsBetweenItsLines) {
  // 1 % damping is 2 Hz wide; lines 25 Hz apart meet its top by chance only.
  const auto peaks = MeasuredPeaks(Resonance(3.5, 0.01, 25.0, 0.001));
  EXPECT_FALSE(peaks[0].zone.has_value());
  EXPECT_THAT(peaks[0].refused, HasSubstr("too far apart"));
}

TEST(MeasuredPeaks, GivesNoZoneToTheEndOfTheLines) {
  FrequencyResponse r = Resonance(3.5, 0.2, 1.0, 0.02);
  r.frequency_hz.erase(r.frequency_hz.begin(), r.frequency_hz.begin() + 120);
  r.sensitivity.erase(r.sensitivity.begin(), r.sensitivity.begin() + 120);
  const auto peaks = MeasuredPeaks(r);
  EXPECT_FALSE(peaks[0].zone.has_value());
  EXPECT_THAT(peaks[0].refused, HasSubstr("first or the last line"));
}

/// |S| = 5 at rest, falling to 1 around `corner_hz`: a law without integrator.
FrequencyResponse Falling(double corner_hz) {
  FrequencyResponse r;
  r.channels = {"x"};
  for (double f = 1.0; f <= 1000.0; f += 1.0) {
    const std::complex<double> s{0.0, f / corner_hz};
    r.frequency_hz.push_back(f);
    r.sensitivity.emplace_back(Eigen::MatrixXcd::Constant(1, 1, (s + 5.0) / (s + 1.0)));
    r.own_variance.emplace_back(Eigen::VectorXd::Constant(1, 1e-6));
  }
  return r;
}

TEST(MeasuredPeaks, GradesAPeakAtZeroFrequencyWhereTheFirstLinesLieFlat) {
  // Lines from 1 Hz: with a corner at 20 Hz the first is 0.1 % below |S(0)| = 5, at 1 Hz 28 %.
  const auto flat = MeasuredPeaks(Falling(20.0));
  EXPECT_EQ(flat[0].refused, "");
  EXPECT_NEAR(flat[0].peak, 5.0, 0.05);
  const auto steep = MeasuredPeaks(Falling(1.0));
  EXPECT_THAT(steep[0].refused, HasSubstr("first or the last line"));
}

TEST(Disagree, BeginsBeyondAFifthOfWhatWasMeasured) {
  EXPECT_FALSE(Disagree(2.41, 3.0));
  EXPECT_TRUE(Disagree(2.39, 3.0));
  EXPECT_TRUE(Disagree(3.61, 3.0));
}

}  // namespace
}  // namespace levitas::identification
