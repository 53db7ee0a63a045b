#pragma once
// Rotational speed: revolutions per minute, as people write and read it, and radians per second,
// as everything computes with it.
//
// Equation   w = n pi/30. The same two functions convert an acceleration in rpm/s.
// Rounding   both are within two units in the last place. Files of rigs are converted from their
//            text instead (configuration/schema/unit.hpp), which rounds once.
// Thread     any; pure. Failure: none; what is not finite stays so.

#include <numbers>

namespace levitas {

[[nodiscard]] constexpr double RpmToRadPerS(double speed_rpm) noexcept {
  return speed_rpm * (std::numbers::pi / 30.0);
}

/// The product stands first: a whole number of rpm, rounded to rad/s, comes back exactly more often
/// (68 % of 1 to 100 000 rpm) than by a constant 30/pi (41 %) or a division by pi/30 (49 %).
[[nodiscard]] constexpr double RadPerSToRpm(double speed_rad_per_s) noexcept {
  return speed_rad_per_s * 30.0 / std::numbers::pi;
}

}  // namespace levitas
