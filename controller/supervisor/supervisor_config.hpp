#pragma once
// Parameters of the mode table and of the protections. Times are in seconds here and become whole
// cycles once, at construction.

#include <cstdint>

namespace levitas::supervisor {

struct SequenceConfig {
  double self_test_s{};           ///< [s] sensors must be plausible for this long before lift
  double lift_ramp_s{};           ///< [s] reference moves from the resting place to the centre
  double lift_settle_s{};         ///< [s] rotor must stay near the centre this long
  double lift_timeout_s{};        ///< [s] lift fails after this
  double settle_radius_m{};       ///< [m] "near the centre", per bearing
  double landing_ramp_s{};        ///< [s] reference moves from the centre to the resting place
  double standstill_rad_per_s{};  ///< [rad/s] below this the rotor counts as standing ...
  double standstill_s{0.2};       ///< [s] ... once it has been for this long, see SpeedWatch
  double trip_acceleration_rad_per_s2{};  ///< [rad/s2] drive's deceleration after a levitated trip
};

struct ProtectionConfig {
  double orbit_fraction{};         ///< [1] of the clearance, trips beyond it (radius per bearing)
  std::uint32_t orbit_cycles{};    ///< cycles beyond it, those inside counted back
  double sensor_range_fraction{};  ///< [1] of the converter's range
  std::uint32_t sensor_range_cycles{};
  std::uint32_t
      sensor_frozen_cycles{};  ///< identical readings of one axis in a row, while levitated
  std::uint32_t frame_missing_cycles{};            ///< consecutive cycles without a frame
  std::uint32_t frames_lost_cycles{30};            ///< cycles without a frame ...
  std::uint32_t frames_lost_window_cycles{100};    ///< ... within this window
  std::uint32_t currents_late_cycles{18};          ///< periods in which the rig held a current ...
  std::uint32_t currents_late_window_cycles{100};  ///< ... within this window
  std::uint32_t deadline_missed_cycles{};          ///< missed periods ...
  std::uint32_t deadline_window_cycles{};          ///< ... within this window
  double coil_saturated_s{};     ///< [s] an axis at its limit without interruption
  double over_speed_fraction{};  ///< [1] of the rated speed
};

struct SupervisorConfig {
  SequenceConfig sequence;
  ProtectionConfig protection;
};

}  // namespace levitas::supervisor
