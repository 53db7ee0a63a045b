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
  EXPECT_NEAR(peaks[0].peak, 3.5, 1e-9);  // a line stands on the top, where S is `peak` exactly
  EXPECT_EQ(peaks[0].frequency_hz, kPeakHz);
  EXPECT_EQ(peaks[0].spacing_hz, 1.0);
  EXPECT_EQ(peaks[0].sigma, 0.02);
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

TEST(Disagree, BeginsBeyondAFifthOfWhatWasMeasured) {
  EXPECT_FALSE(Disagree(2.41, 3.0));
  EXPECT_TRUE(Disagree(2.39, 3.0));
  EXPECT_TRUE(Disagree(3.61, 3.0));
}

}  // namespace
}  // namespace levitas::identification
