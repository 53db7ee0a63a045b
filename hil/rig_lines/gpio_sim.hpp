#pragma once
// The far end of lines whose chip is the kernel's gpio-sim: what a controller drives can be read,
// what it reads can be pulled. For the simulated rig and for tests.
//
// Levels     active and inactive, as in hil/gpio/line_config.hpp; active_high is undone here.
// Thread     one owner; Driven and Pull are one system call each, no allocation.
// Failure    the constructor throws Problem when a chip is not there or is not a gpio-sim.
//            A Pull that fails returns false; a line that cannot be read counts as inactive.

#include <memory>

#include "hil/gpio/line_config.hpp"

namespace levitas::gpio {

class SimulatedLine {
 public:
  explicit SimulatedLine(const LinePlace& place);
  ~SimulatedLine();
  SimulatedLine(const SimulatedLine&) = delete;
  SimulatedLine& operator=(const SimulatedLine&) = delete;

  /// True while the level is the active one.
  [[nodiscard]] bool Driven() const noexcept;
  bool Pull(bool active) noexcept;

 private:
  bool active_high_;
  int value_file_{-1};
  int pull_file_{-1};
};

}  // namespace levitas::gpio
