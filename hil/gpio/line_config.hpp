#pragma once
// The lines between controller and rig as a rig file describes them. Plain data; docs/real_rig.md.
//
// Active   each function has one active meaning (docs/real_rig.md); `active_high` says which level
//          of the wire that is. Everything above the adapter speaks of active and inactive only.
// Absent   a function that the rig does not have is nullopt, never a line number of its own.

#include <cstdint>
#include <optional>
#include <string>

namespace levitas::gpio {

/// Who keeps a line at its safe level when nobody drives it.
enum class Bias : std::uint8_t {
  kExternal = 0,  ///< a resistor on the board
  kInternal = 1,  ///< the pull of the chip, asked for together with the line
};

struct LinePlace {
  std::string chip;        ///< name, label or path: "gpiochip0", "pinctrl-bcm2711"
  std::uint32_t offset{};  ///< of the line within its chip
  bool active_high{true};
  Bias bias{Bias::kExternal};
};

struct HeartbeatConfig {
  LinePlace line;
  std::uint32_t toggle_cycles{5};  ///< cycles of the controller between two edges
  double timeout_s{0.005};         ///< the rig gives up after this long without an edge
};

struct KeyPhasorConfig {
  LinePlace line;
  std::uint32_t pulses_per_turn{1};
  double angle_rad{};                    ///< of the rotor at a pulse
  double max_acceleration_rad_per_s2{};  ///< beyond it a change of speed is not believed
  double jitter_s{};                     ///< of a time stamp, both ways
};

struct LinesConfig {
  std::optional<LinePlace> emergency_stop;    ///< input; active: the chain is closed
  std::optional<LinePlace> amplifier_enable;  ///< output; active: amplifiers may drive current
  std::optional<LinePlace> amplifier_fault;   ///< input; active: an amplifier reports a fault
  std::optional<HeartbeatConfig> heartbeat;   ///< output; edges while the cycle runs
  std::optional<KeyPhasorConfig> key_phasor;  ///< input; becomes active once per mark
  double watchdog_s{0.02};  ///< the guard drops the enable line after this long without a cycle

  [[nodiscard]] bool empty() const noexcept {
    return !emergency_stop && !amplifier_enable && !amplifier_fault && !heartbeat && !key_phasor;
  }
};

}  // namespace levitas::gpio
