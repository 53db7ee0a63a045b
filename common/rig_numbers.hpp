#pragma once
// Numbers of a rig that both the controller and the plant need (and nothing else of the rig).

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "common/axes.hpp"

namespace levitas {

struct RigNumbers {
  std::string name;                     ///< "flexible_rotor"
  std::vector<std::string> channels;    ///< axis names in order: de_x, de_y, nde_x, nde_y
  std::vector<std::string> bearings;    ///< bearing names in order: de, nde; axes 2b and 2b+1
  std::int64_t period_ns{100'000};      ///< [ns] sampling period
  double bias_current_a{};              ///< [A] i0
  double max_coil_current_a{};          ///< [A] a coil current stays within 0 .. this
  double clearance_m{};                 ///< [m] smallest radial clearance of the touchdown bearings
  double sensor_range_m{};              ///< [m] smallest range: the converter covers +- this
  std::vector<double> clearances_m;     ///< [m] bearing by bearing; empty: clearance_m everywhere
  std::vector<double> sensor_ranges_m;  ///< [m] the same of the ranges
  /// [m] s0 of F = k (i/s)^2, bearing by bearing; empty: a magnet has another law of force.
  std::vector<double> magnet_gaps_m;
  double max_speed_rad_per_s{};  ///< [rad/s] rated speed; the over-speed trip refers to it
  /// [rad/s2] what the drive can do: a faster change of speed is refused.
  double max_acceleration_rad_per_s2{std::numeric_limits<double>::infinity()};
  AxisArray sensor_polarity{};          ///< +1 or -1 per axis, see controller/cycle
  AxisArray actuator_polarity{};        ///< +1 or -1 per axis
  double standing_orbit_objective_m{};  ///< [m] orbit radius at standstill to stay below
  double spinning_orbit_objective_m{};  ///< [m] orbit radius while rotating to stay below

  [[nodiscard]] std::size_t axes() const noexcept { return channels.size(); }
  [[nodiscard]] double ClearanceOf(std::size_t bearing) const noexcept {
    return bearing < clearances_m.size() ? clearances_m[bearing] : clearance_m;
  }
  [[nodiscard]] double SensorRangeOf(std::size_t bearing) const noexcept {
    return bearing < sensor_ranges_m.size() ? sensor_ranges_m[bearing] : sensor_range_m;
  }
  /// What a number on the bus or a field of a page must be able to hold.
  [[nodiscard]] double LargestSensorRange() const noexcept {
    double largest_m = sensor_range_m;
    for (const double range_m : sensor_ranges_m) largest_m = std::max(largest_m, range_m);
    return largest_m;
  }
  [[nodiscard]] double LargestClearance() const noexcept {
    double largest_m = clearance_m;
    for (const double bearing_m : clearances_m) largest_m = std::max(largest_m, bearing_m);
    return largest_m;
  }
  [[nodiscard]] double period_s() const noexcept { return static_cast<double>(period_ns) * 1e-9; }
};

}  // namespace levitas
