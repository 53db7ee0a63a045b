#pragma once
// The simulated rig's end of the lines: its amplifiers obey enable and heartbeat, its shaft carries
// the key phasor's mark, its stop chain is closed until somebody opens it.
//
// Stop chain, fault   set to healthy once, at the start; after that they belong to whoever pulls
//                     the simulated line (docs/real_rig.md says how).
// Key phasor          active for half a mark spacing from each mark on. An edge comes at the next
//                     period after its mark, so its time stamp is late by up to one period.
// Thread              Poll, Turn: the rig's loop; two to four system calls, no allocation. The
//                     counters: any thread.
// Failure             Problem at construction; later a line that cannot be read is inactive.

#include <atomic>
#include <cstdint>
#include <optional>

#include "hil/gpio/line_config.hpp"
#include "hil/gpio/rig_gate.hpp"
#include "hil/rig_lines/gpio_sim.hpp"

namespace levitas::gpio {

class RigLines {
 public:
  struct Counters {
    std::atomic<std::uint64_t> opened{0};
    std::atomic<std::uint64_t> enable_falls{0};
    std::atomic<std::uint64_t> heartbeat_losses{0};
  };

  explicit RigLines(const LinesConfig& config);

  /// Once per period: reads enable and heartbeat. True: the amplifiers may drive current.
  bool Poll(std::int64_t now_ns) noexcept;
  /// The rotor stands at this angle: moves the key phasor's line.
  void Turn(double angle_rad) noexcept;
  [[nodiscard]] bool open() const noexcept { return gate_.open(); }
  [[nodiscard]] const Counters& counters() const noexcept { return counters_; }

 private:
  std::optional<SimulatedLine> enable_;
  std::optional<SimulatedLine> heartbeat_;
  std::optional<SimulatedLine> key_phasor_;
  double mark_rad_{};
  double spacing_rad_{};
  bool on_mark_{false};
  RigGate gate_;
  Counters counters_;
};

}  // namespace levitas::gpio
