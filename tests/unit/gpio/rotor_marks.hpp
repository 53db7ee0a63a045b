#pragma once
// Times at which the mark of a rotor under constant acceleration passes the probe, in closed form:
//   angle(t) = w t + a t^2 / 2 = k d   =>   t_k = 2 k d / (w + sqrt(w^2 + 2 a k d)).

#include <cmath>
#include <cstdint>
#include <numbers>

#include "hil/gpio/key_phasor.hpp"

namespace levitas::gpio::test {

inline constexpr double kTurnRad = 2.0 * std::numbers::pi;

struct Rotor {
  double speed_rad_per_s{};  ///< at time 0, when mark 0 passes
  double acceleration_rad_per_s2{};
  double spacing_rad{kTurnRad};

  [[nodiscard]] double MarkS(int k) const {
    const double angle_rad = k * spacing_rad;
    const double w = speed_rad_per_s;
    return 2.0 * angle_rad / (w + std::sqrt(w * w + 2.0 * acceleration_rad_per_s2 * angle_rad));
  }
  [[nodiscard]] std::int64_t MarkNs(int k) const { return std::llround(MarkS(k) * 1e9); }
  [[nodiscard]] double SpeedAt(double time_s) const {
    return speed_rad_per_s + acceleration_rad_per_s2 * time_s;
  }
  [[nodiscard]] double AngleAt(double time_s) const {
    return std::fmod(speed_rad_per_s * time_s + 0.5 * acceleration_rad_per_s2 * time_s * time_s,
                     kTurnRad);
  }
};

inline KeyPhasorConfig Config(std::uint32_t pulses_per_turn = 1) {
  KeyPhasorConfig config;
  config.pulses_per_turn = pulses_per_turn;
  config.max_acceleration_rad_per_s2 = 420.0;  // twice a drive of 2000 rpm/s
  config.jitter_s = 20e-6;
  return config;
}

/// 3000 rpm; its mark passes every 20 ms.
inline constexpr double kSpeed = 100.0 * std::numbers::pi;
inline constexpr std::int64_t kTurnNs = 20'000'000;

/// A key phasor that has seen marks 0 .. `marks` - 1 at the constant speed above.
inline KeyPhasor Running(int marks = 10) {
  KeyPhasor key_phasor(Config());
  for (int k = 0; k < marks; ++k) key_phasor.Pulse(k * kTurnNs);
  return key_phasor;
}

}  // namespace levitas::gpio::test
