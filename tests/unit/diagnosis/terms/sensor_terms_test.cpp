// Terms of sensors against their characteristics.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

class SensorTermsTest : public ::testing::Test {
 protected:
  [[nodiscard]] Contribution Of(const std::string& effect, const std::string& place,
                                const std::string& parameter, double theta) const {
    Term term = Named(terms_, effect, place, parameter);
    return Added(term, moment_, theta);
  }
  Random random_{8};
  SamplePoint moment_ = Drawn(random_, 0.0);
  std::vector<Term> terms_ = EveryTerm();
  double y_ = static_cast<double>(moment_.reading_m[1]);
};

TEST_F(SensorTermsTest, GainOffsetAndCharacteristicAreAPolynomialOfTheReading) {
  EXPECT_NEAR(Of("sensor_gain", "de_y", "ratio", 0.04).reading_m[1], 0.04 * y_, 1e-15);
  EXPECT_EQ(Of("sensor_offset", "de_y", "offset_m", 7e-6).reading_m[1], 7e-6);
  EXPECT_NEAR(Of("sensor_nonlinearity", "de_y", "a2", 2000.0).reading_m[1], 2000.0 * y_ * y_,
              1e-15);
  EXPECT_NEAR(Of("sensor_nonlinearity", "de_y", "a3", 5e7).reading_m[1], 5e7 * y_ * y_ * y_, 1e-15);
}

TEST_F(SensorTermsTest, OfOneAxisLeaveTheOthersAndTheForcesAlone) {
  for (const char* effect :
       {"sensor_gain", "sensor_offset", "sensor_nonlinearity", "sensor_bandwidth"}) {
    Term term = Named(terms_, effect, "de_y");
    const Contribution add = Added(term, moment_, term.step);
    for (const std::size_t a : {0U, 2U, 3U}) EXPECT_EQ(add.reading_m[a], 0.0) << effect;
    for (std::size_t a = 0; a < TheRig().axes; ++a) EXPECT_EQ(add.force_n[a], 0.0) << effect;
  }
}

// A sine on one mode, seen through filters of two bandwidths: the difference of their responses.
TEST_F(SensorTermsTest, ASlowerSensorIsAFilterOfLowerBandwidth) {
  constexpr double kHz = 300.0;
  constexpr double kSlower = 4.0;
  const double w = 2.0 * std::numbers::pi * kHz;
  const double lag_s = 1.0 / (2.0 * std::numbers::pi * TheRig().bearing(1).sensor.bandwidth_hz);
  const auto filter = [w](double tau_s) { return 1.0 / std::complex<double>(1.0, w * tau_s); };
  const std::complex<double> expected = filter(kSlower * lag_s) - filter(lag_s);
  Term term = Named(terms_, "sensor_bandwidth", "de_y");
  SamplePoint m;
  m.restarted = true;
  double most = 0.0;
  for (int n = 0; n < 2000; ++n) {
    const double t = n * TheRig().period_s;
    m.v[TheRig().modes] = static_cast<float>(w * std::cos(w * (t + 0.5 * TheRig().period_s)));
    const double position = TheRig().magnet(1).sensor_shape[0];
    // Of the sample at the end of the period.
    const double reading = Added(term, m, kSlower - 1.0).reading_m[1] / position;
    m.restarted = false;
    const double wanted = (expected * std::polar(1.0, w * (t + TheRig().period_s))).imag();
    if (n > 200) most = std::max(most, std::abs(reading - wanted));
  }
  // The velocity is not steady between samples: (w T)^2/24 of it.
  EXPECT_LT(most, 0.01 * std::abs(expected));
}

TEST_F(SensorTermsTest, ASensorElsewhereReadsTheSlopeOfTheShaft) {
  const double z = TheRig().model->config().bearings[0].sensor_z_m;
  const auto slope = TheRig().Slope(z);
  double x = 0.0;
  double y = 0.0;
  // Behind a first-order filter the reading is v/w behind.
  const double lag_s = 1.0 / (2.0 * std::numbers::pi * TheRig().bearing(0).sensor.bandwidth_hz);
  const auto seen = [&](std::size_t at) {
    return static_cast<double>(moment_.read_q[at]) -
           lag_s * static_cast<double>(moment_.read_v[at]);
  };
  for (std::size_t i = 0; i < TheRig().modes; ++i) {
    x += slope[i] * seen(i);
    y += slope[i] * seen(TheRig().modes + i);
  }
  const Contribution add = Of("sensor_position", "de", "shift_m", 2e-3);
  EXPECT_NEAR(add.reading_m[0], 2e-3 * x, 1e-12);
  EXPECT_NEAR(add.reading_m[1], 2e-3 * y, 1e-12);
  EXPECT_EQ(add.reading_m[2], 0.0);
}

TEST_F(SensorTermsTest, TurnedSensorsReadATurnedPlace) {
  const Contribution add = Of("axis_rotation", "sensor de", "angle_rad", 0.03);
  const double x = static_cast<double>(moment_.reading_m[0]);
  const double y = static_cast<double>(moment_.reading_m[1]);
  // Axes turned by +theta see the place turned by -theta.
  EXPECT_NEAR(x + add.reading_m[0], x * std::cos(0.03) + y * std::sin(0.03), 5e-4 * std::abs(x));
  EXPECT_NEAR(y + add.reading_m[1], y * std::cos(0.03) - x * std::sin(0.03), 5e-4 * std::abs(y));
}

TEST(MainsTermsTest, HaveAPhaseOfTheirOwnInEveryRecord) {
  std::vector<Term> terms = MainsTerms(TheRig(), {50.0}, 2);
  ASSERT_EQ(terms.size(), 2 * 2 * TheRig().axes);
  SamplePoint m;
  m.time_s = 1.0 / 200.0;  // a quarter of a period
  m.record = 1;
  double total = 0.0;
  for (Term& term : terms) {
    const Contribution add = Added(term, m, 1e-6);
    double reading = 0.0;
    for (const double each : add.reading_m) reading += each;
    const bool sine_of_this_record = term.record == 1 && term.parameter == "sine";
    EXPECT_NEAR(reading, sine_of_this_record ? 1e-6 : 0.0, 1e-15);
    total += reading;
  }
  EXPECT_NEAR(total, 1e-6 * static_cast<double>(TheRig().axes), 1e-14);
}

}  // namespace
}  // namespace levitas::diagnosis
