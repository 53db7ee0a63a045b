#pragma once
// What crosses the boundary between controller and rig, once per period, as plain data.
//
// Frame   axes and order are those of the rig file's bearing frame (x, y per bearing; positive x
//         towards the coil that a positive control current strengthens), scaled by the port.
//         Signs are as wired: controller/cycle and every reader of records remove the polarity.
// Units   SI, named in the identifiers.
// Time    `cycle` is the integer number of the period; `_ns` is CLOCK_MONOTONIC in real time and
//         cycle x period in lockstep.

#include <cstdint>

#include "common/axes.hpp"

namespace levitas {

/// Bits of SensorFrame::rig_status, raised by the rig.
enum RigStatus : std::uint32_t {
  kRigEmergencyStop = 1U << 0,   ///< the rig's emergency stop chain is open
  kRigAmplifierFault = 1U << 1,  ///< an amplifier reports a fault
  kRigCurrentHeld = 1U << 2,     ///< no new current arrived in time: the rig held the last one
  kRigAmplifiersOff = 1U << 3,   ///< amplifiers are de-energised (not enabled, or rig watchdog)
  kRigSpeedUnknown = 1U << 4,    ///< the key phasor's pulses contradict what a rotor can do
};

struct SensorFrame {
  std::uint64_t cycle{};          ///< number of the sampling instant, counted by the rig
  std::int64_t sample_time_ns{};  ///< when it was sampled
  std::uint32_t rig_session{};    ///< drawn anew each time the rig starts; a change = a restart
  std::uint32_t rig_status{};     ///< RigStatus bits
  std::uint32_t held_currents{};  ///< periods, since the rig started, that reused an old current
  std::uint32_t axes{};           ///< valid entries in position_m
  AxisArray position_m{};         ///< [m] as the sensors read it (sensor plane, not actuator plane)
  double speed_rad_per_s{};       ///< [rad/s] rotation, positive from x to y
  double angle_rad{};             ///< [rad] rotor angle at the sampling instant, 0 <= angle < 2 pi
};

struct CurrentFrame {
  std::uint64_t cycle{};          ///< the SensorFrame::cycle this answers
  std::uint32_t axes{};           ///< valid entries in control_current_a
  AxisArray control_current_a{};  ///< [A] ic per axis, excitation included: coils get i0+ic, i0-ic
  double bias_current_a{};        ///< [A] i0; 0 when not levitated
  double speed_set_point_rad_per_s{};      ///< [rad/s] for the rig's drive
  double acceleration_limit_rad_per_s2{};  ///< [rad/s2] for the rig's drive
  bool amplifiers_enabled{};               ///< false: both coils of every axis are de-energised
  bool drive_enabled{};                    ///< false: the drive gives no torque, the rotor coasts
};

}  // namespace levitas
