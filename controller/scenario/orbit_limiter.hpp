#pragma once
// Keeps an excitation from driving the rotor into its touchdown bearings.
//
// Equation   gain g, 0 <= g <= 1, multiplies every excitation of a step. With r the largest radius
//            of any bearing and R the limit:
//              r >= 1.5 R       g = 0
//              r > R            g' = -g/tau_cut,           tau_cut = 1 ms
//              r < 0.8 R        g' = (1 - g)/tau_recovery, tau_recovery = 1 s
// Why        a rotor in magnetic bearings answers an excitation within some milliseconds, so the
//            gain has to fall faster and come back slower than that.
// Thread     one; no allocation, no throw; a radius that is not a number cuts the excitation off.
// Not done   what moves the rotor besides the excitation is not the limiter's to stop.

#include <cmath>

namespace levitas::scenario {

class OrbitLimiter {
 public:
  static constexpr double kCutS = 1e-3;
  static constexpr double kRecoveryS = 1.0;
  static constexpr double kOff = 1.5;
  static constexpr double kQuiet = 0.8;
  static constexpr double kWhole = 0.99;  ///< a gain that comes back exponentially counts as 1

  explicit OrbitLimiter(double period_s)
      : keep_(std::exp(-period_s / kCutS)), recover_(-std::expm1(-period_s / kRecoveryS)) {}

  void Reset() noexcept { gain_ = 1.0; }

  /// Gain for this cycle; a limit of 0 is none.
  double Next(double radius_m, double limit_m) noexcept {
    if (!(limit_m > 0.0)) return gain_ = 1.0;
    if (!(radius_m < kOff * limit_m)) {
      gain_ = 0.0;
    } else if (radius_m > limit_m) {
      gain_ *= keep_;
    } else if (radius_m < kQuiet * limit_m) {
      gain_ += recover_ * (1.0 - gain_);
    }
    return gain_;
  }

 private:
  double keep_;
  double recover_;
  double gain_{1.0};
};

}  // namespace levitas::scenario
