#pragma once
// The rig's lines through libgpiod: requested at their safe levels, dropped to them in every end.
//
// Request    outputs become outputs at their inactive level in one step of the kernel: no glitch.
// End        the destructor writes inactive levels, then gives the lines back.
// Crash      see line_guard.hpp: a process of its own holds the enable line beside us.
// Thread     the constructor before any thread is started (it forks); the rest loop thread, except
//            guard_alive (any).
// Cost       one system call for each input and cycle, one for each edge of an output. Chips behind
//            I2C or SPI sleep in that call: not for the cycle (docs/real_rig.md).
// Failure    Problem with every line that could not be had and why. Afterwards: hil/gpio/lines.hpp.

#include <memory>

#include "hil/gpio/line_config.hpp"
#include "hil/gpio/lines.hpp"

namespace levitas::gpio {

class GpiodLines final : public Lines {
 public:
  explicit GpiodLines(const LinesConfig& config);
  ~GpiodLines() override;
  GpiodLines(const GpiodLines&) = delete;
  GpiodLines& operator=(const GpiodLines&) = delete;

  [[nodiscard]] InputLevels ReadInputs() noexcept override;
  [[nodiscard]] std::size_t ReadPulses(std::span<std::int64_t> time_ns) noexcept override;
  bool WriteEnable(bool active) noexcept override;
  bool WriteHeartbeat(bool active) noexcept override;
  void CycleDone() noexcept override;

  /// False when the guard process has ended before us.
  [[nodiscard]] bool guard_alive() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::gpio
