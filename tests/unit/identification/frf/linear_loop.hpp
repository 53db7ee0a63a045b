#pragma once
// A coupled, unstable plant of two axes in the loop of a known controller, recorded in memory: its
// frequency response is a closed form, so an estimate from the record can be held against it.
//
// Equation  y[n] = A1 y[n-1] + A2 y[n-2] + B u[n-1],  reading = y + noise + run-out,
//           u = -c reading + e, or u = -c (reading + e) with e / c for e,
//           P(z) = (I - A1 z^-1 - A2 z^-2)^-1 B z^-1.
// Poles     1.18 and 0.72 alone; of magnitude 0.93 in the loop, so that a transient falls below
//           rounding within one period of the test signal (0.93^510 = 1e-16).
// Units     m, A. Every random number has a seed.

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "common/random.hpp"
#include "identification/frf/experiments.hpp"
#include "session/exchange/recording.hpp"

namespace levitas::test {

struct LoopPlan {
  std::size_t period_samples{510};
  std::size_t periods{5};
  double controller_a_per_m{1e5};
  double noise_m{};
  double run_out_m{};
  double speed_rad_per_s{};
  identification::SummingPoint point{identification::SummingPoint::kCurrent};
  bool flat{true};  ///< all lines alike strong; else a random binary signal
  std::uint64_t seed{1};
};

class LinearLoop {
 public:
  static constexpr double kPeriodS = 1e-4;

  [[nodiscard]] static Eigen::Matrix2cd Plant(double frequency_hz) {
    const auto later = std::polar(1.0, -2.0 * std::numbers::pi * frequency_hz * kPeriodS);
    const Eigen::Matrix2cd left =
        Eigen::Matrix2cd::Identity() - A1() * later - A2() * later * later;
    return left.inverse() * B() * later;
  }
  [[nodiscard]] static Eigen::Matrix2cd Sensitivity(double frequency_hz,
                                                    double controller_a_per_m) {
    return (Eigen::Matrix2cd::Identity() + controller_a_per_m * Plant(frequency_hz)).inverse();
  }

  /// One axis excited after the other by the same signal.
  [[nodiscard]] static session::Recording Run(const LoopPlan& plan) {
    Random random(plan.seed);
    const std::vector<double> signal =
        plan.flat ? Multisine(plan.period_samples, random) : Binary(plan.period_samples, random);
    const std::size_t rows_per_axis = plan.periods * plan.period_samples;
    session::Recording r = Empty(2 * rows_per_axis, plan.speed_rad_per_s);
    Eigen::Vector2d y = Eigen::Vector2d::Zero();
    Eigen::Vector2d before = y;
    Eigen::Vector2d u = y;
    for (std::size_t row = 0; row < r.rows(); ++row) {
      const Eigen::Vector2d next = A1() * y + A2() * before + B() * u;
      before = y;
      y = next;
      const std::size_t axis = row / rows_per_axis;
      for (std::size_t i = 0; i < 2; ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        r.position_m[i][row] =
            y[at] + plan.noise_m * random.Normal() +
            plan.run_out_m * std::cos(r.angle_rad[row] - static_cast<double>(i) * 1.5);
        const double excitation_a = i == axis ? signal[row % plan.period_samples] : 0.0;
        u[at] = excitation_a - plan.controller_a_per_m * r.position_m[i][row];
        if (plan.point == identification::SummingPoint::kCurrent) {
          r.excitation_a[i][row] = excitation_a;
        } else {
          r.excitation_m[i][row] = -excitation_a / plan.controller_a_per_m;
        }
        r.current_a[i][row] = u[at];
      }
    }
    return r;
  }

  /// A levitated record in which nothing happens.
  [[nodiscard]] static session::Recording Empty(std::size_t rows, double speed_rad_per_s) {
    session::Recording r;
    r.name = "loop.csv";
    r.period_ns = 100'000;
    r.channels = {"x", "y"};
    r.sensor_range_m = {1.0, 1.0};
    r.current_limit_a = 10.0;
    r.levitated.assign(rows, 1);
    r.amplifiers_enabled.assign(rows, 1);
    r.speed_rad_per_s.assign(rows, speed_rad_per_s);
    r.bias_current_a.assign(rows, 1.0);
    for (std::size_t row = 0; row < rows; ++row) {
      r.cycle.push_back(row);
      r.angle_rad.push_back(
          std::fmod(speed_rad_per_s * kPeriodS * static_cast<double>(row), 2.0 * std::numbers::pi));
    }
    const std::vector<session::Column> zeros(2, session::Column(rows, 0.0));
    r.position_m = r.current_a = r.excitation_a = r.excitation_m = zeros;
    return r;
  }

 private:
  /// All lines alike strong, about 0.1 A rms, with random phases.
  [[nodiscard]] static std::vector<double> Multisine(std::size_t samples, Random& random) {
    std::vector<double> signal(samples, 0.0);
    const auto lines = static_cast<double>(samples / 2 - 1);
    for (std::size_t k = 1; k < samples / 2; ++k) {
      const double phase = 2.0 * std::numbers::pi * random.Uniform();
      for (std::size_t n = 0; n < samples; ++n) {
        const auto turn = static_cast<double>(k * n % samples) / static_cast<double>(samples);
        signal[n] += 0.1 * std::sqrt(2.0 / lines) * std::cos(2.0 * std::numbers::pi * turn + phase);
      }
    }
    return signal;
  }
  /// Power of the lines is exponentially distributed: some are hardly excited.
  [[nodiscard]] static std::vector<double> Binary(std::size_t samples, Random& random) {
    std::vector<double> signal(samples);
    for (double& value : signal) value = random.Uniform() < 0.5 ? -0.1 : 0.1;
    return signal;
  }
  [[nodiscard]] static Eigen::Matrix2d A1() {
    return (Eigen::Matrix2d() << 1.9, 0.01, -0.01, 1.89).finished();
  }
  [[nodiscard]] static Eigen::Matrix2d A2() { return -0.85 * Eigen::Matrix2d::Identity(); }
  [[nodiscard]] static Eigen::Matrix2d B() {
    return (Eigen::Matrix2d() << 1e-6, 1e-7, 5e-8, 9e-7).finished();
  }
};

}  // namespace levitas::test
