#pragma once
// The lines as the control cycle uses them: real ones (hil/libgpiod) or those of a test.
//
// Units      time in ns of CLOCK_MONOTONIC.
// Thread     loop thread only.
// Blocking   no call waits; each is at most one system call for each line.
// Absent     a line that the rig file does not name reads as healthy and takes every write.
// Failure    a line that cannot be read is one that says stop: `readable` is false. A failed write
//            returns false. Nothing throws.

#include <cstddef>
#include <cstdint>
#include <span>

namespace levitas::gpio {

struct InputLevels {
  bool stop_chain_closed{true};
  bool amplifier_fault{false};
  bool readable{true};  ///< false: the kernel refused one of them
};

class Lines {
 public:
  virtual ~Lines() = default;
  [[nodiscard]] virtual InputLevels ReadInputs() noexcept = 0;
  /// Times at which the key phasor became active since the last call, oldest first; what does not
  /// fit is left for the next call. Returns how many were written.
  [[nodiscard]] virtual std::size_t ReadPulses(std::span<std::int64_t> time_ns) noexcept = 0;
  /// False also when the guard has given up on this controller: the line then stays inactive.
  virtual bool WriteEnable(bool active) noexcept = 0;
  virtual bool WriteHeartbeat(bool active) noexcept = 0;
  /// Once per cycle: tells the guard that the cycle runs.
  virtual void CycleDone() noexcept = 0;
};

}  // namespace levitas::gpio
