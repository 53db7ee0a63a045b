// Complex amplitudes of what turns with the rotor, against signals made in closed form.
#include "analysis/records/order_track.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "common/random.hpp"
#include "common/two_pi.hpp"

namespace levitas::analysis {
namespace {

using Complex = std::complex<double>;

constexpr double kPeriodS = 1e-4;

struct Signal {
  double speed_rad_per_s{400.0};
  double acceleration_rad_per_s2{};
  Complex position_m{3e-6, -4e-6};
  Complex current_a{-0.02, 0.01};
  double mean_m{7e-6};
  double noise_m{};
  double second_order_m{};
};

/// One axis, the angle wrapped as a record has it.
session::Recording Record(const Signal& signal, std::size_t rows) {
  session::Recording record;
  record.name = "made";
  record.period_ns = 100'000;
  record.channels = {"x"};
  record.sensor_range_m = {1e-3};
  record.current_limit_a = 1.0;
  record.position_m.resize(1);
  record.current_a.resize(1);
  record.excitation_a.resize(1);
  record.excitation_m.resize(1);
  Random draw(20261126);
  for (std::size_t n = 0; n < rows; ++n) {
    const double t = kPeriodS * static_cast<double>(n);
    const double angle =
        0.7 + t * (signal.speed_rad_per_s + 0.5 * signal.acceleration_rad_per_s2 * t);
    const Complex turned = std::polar(1.0, angle);
    record.cycle.push_back(n);
    record.levitated.push_back(1);
    record.speed_rad_per_s.push_back(signal.speed_rad_per_s + signal.acceleration_rad_per_s2 * t);
    record.angle_rad.push_back(std::fmod(angle, kTwoPi));
    record.bias_current_a.push_back(1.0);
    record.position_m[0].push_back(signal.mean_m + (signal.position_m * turned).real() +
                                   signal.second_order_m * std::cos(2.0 * angle) +
                                   signal.noise_m * draw.Normal());
    record.current_a[0].push_back((signal.current_a * turned).real());
  }
  return record;
}

TEST(OrderTrack, FindsAmplitudesWithTheirPhaseAndTheMean) {
  const auto windows = TrackOrder(Record({.second_order_m = 5e-6}, 20'000), {});
  ASSERT_GT(windows.size(), 10U);
  for (const TrackedWindow& window : windows) {
    // Exact but for the rounding of the normal equations.
    EXPECT_NEAR(std::abs(window.position_m[0] - Complex(3e-6, -4e-6)), 0.0, 1e-15);
    EXPECT_NEAR(std::abs(window.current_a[0] - Complex(-0.02, 0.01)), 0.0, 1e-12);
    EXPECT_NEAR(window.mean_position_m[0], 7e-6, 1e-15);
    EXPECT_NEAR(window.speed_rad_per_s, 400.0, 1e-9);
  }
}

TEST(OrderTrack, RefersToTheRecordedAngleAlsoWhenItFalls) {
  const auto windows = TrackOrder(Record({.speed_rad_per_s = -400.0}, 5'000), {});
  ASSERT_FALSE(windows.empty());
  for (const TrackedWindow& window : windows) {
    EXPECT_LT(window.speed_rad_per_s, 0.0);
    EXPECT_NEAR(std::abs(window.position_m[0] - Complex(3e-6, -4e-6)), 0.0, 1e-15);
  }
}

TEST(OrderTrack, KnowsHowFastTheSpeedChanges) {
  const auto windows = TrackOrder(Record({.acceleration_rad_per_s2 = 80.0}, 20'000), {});
  ASSERT_FALSE(windows.empty());
  for (const TrackedWindow& window : windows) {
    EXPECT_NEAR(window.acceleration_rad_per_s2, 80.0, 1e-6);
    EXPECT_NEAR(window.speed_rad_per_s, 400.0 + 80.0 * window.time_s, 1e-2);
    EXPECT_NEAR(std::abs(window.position_m[0] - Complex(3e-6, -4e-6)), 0.0, 1e-15);
  }
}

TEST(OrderTrack, SaysHowMuchOfTheNoiseIsLeft) {
  const double noise_m = 1e-6;
  const auto windows = TrackOrder(Record({.noise_m = noise_m}, 200'000), {});
  double square = 0.0;
  for (const TrackedWindow& window : windows) {
    const double expected = 4.0 * noise_m * noise_m / window.samples;
    square += std::norm(window.position_m[0] - Complex(3e-6, -4e-6)) / expected;
  }
  // About 400 windows with two numbers each, a sixth of them shared: 5 % deviation, four of them.
  EXPECT_NEAR(square / static_cast<double>(windows.size()), 1.0, 0.2);
}

TEST(OrderTrack, LeavesOutClippedReadingsAndCommandsBeyondTheLimit) {
  session::Recording record = Record({}, 20'000);
  for (std::size_t row = 0; row < 10'000; ++row) record.position_m[0][row] = 2e-3;
  for (std::size_t row = 15'000; row < 20'000; ++row) record.current_a[0][row] = 1.2;
  for (const TrackedWindow& window : TrackOrder(record, {})) {
    EXPECT_GT(window.time_s, 1.0);
    EXPECT_LT(window.time_s, 1.5);
  }
  EXPECT_FALSE(TrackOrder(record, {}).empty());
}

TEST(OrderTrack, HasNoWindowsOfARotorThatStands) {
  EXPECT_TRUE(TrackOrder(Record({.speed_rad_per_s = 1.0}, 20'000), {}).empty());
}

}  // namespace
}  // namespace levitas::analysis
