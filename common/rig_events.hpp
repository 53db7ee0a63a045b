#pragma once
// What a scenario lets happen to the rig at given times: faults of its parts, changes of an effect,
// torques from outside.
//
// Time   seconds of the rig's own time, from the first frame that the controller answers.

#include <cstddef>
#include <cstdint>
#include <string>

namespace levitas {

enum class RigEventKind : std::uint8_t {
  kSensorFrozen,   ///< an axis goes on reading what it read last
  kSensorStuck,    ///< an axis reads `value_m`, as with a broken cable
  kSensorInvalid,  ///< an axis reads not a number
  kSensorJump,     ///< `value_m` is added to what an axis reads
  kAmplifierFault,
  kEmergencyStop,  ///< the rig's emergency stop chain opens
  kEffect,         ///< an effect of the rig file goes to another strength
  kTorque          ///< a torque acts on a torsional inertia of a geared shaft
};

struct ScheduledRigEvent {
  RigEventKind kind{};
  double at_s{};
  double duration_s{};  ///< of a fault or torque; 0: for good
  std::string channel;  ///< "de_x", of a sensor fault
  std::size_t axis{};   ///< index of the channel in the rig
  double value_m{};
  std::string effect;     ///< id of an entry of the rig's `effects`
  double strength{};      ///< of the effect from then on
  double ramp_s{};        ///< to get there, and of a torque back; 0: at once
  std::string inertia{};  ///< name of a torsional inertia
  double torque_n_m{};    ///< in the sense in which the first shaft turns
};

}  // namespace levitas
