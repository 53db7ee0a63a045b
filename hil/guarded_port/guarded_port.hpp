#pragma once
// Any port with the rig's lines beside it: what the lines say becomes part of the frame, what the
// current frame says becomes part of the lines.
//
// In         an open stop chain, an amplifier's fault and an unknown speed become bits of
//            rig_status, so they are recorded, replayed and judged like those the rig sends itself.
//            Speed and angle come from the key phasor where there is one, at the frame's sampling
//            instant.
// Out        the enable line follows amplifiers_enabled; the heartbeat is stepped once per Write.
//            The frame goes first, so the lines add nothing to its latency.
// No frame   the bits are set in the caller's last frame as well: a stop does not wait for the bus.
// Thread     loop thread only.
// Failure    that of the port below; lines that cannot be read count as an open chain, an enable
//            line that cannot be written as an amplifier's fault.
// Not done   no debouncing: a chain that opens for one cycle has opened.

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "common/rig_port.hpp"
#include "hil/gpio/heartbeat.hpp"
#include "hil/gpio/key_phasor.hpp"
#include "hil/gpio/line_config.hpp"
#include "hil/gpio/lines.hpp"

namespace levitas::gpio {

struct LineCounters {
  std::uint64_t stops{};           ///< the chain opened
  std::uint64_t enables{};         ///< the enable line became active
  std::uint64_t write_failures{};  ///< cycles in which an output could not be written
  PulseCounters pulses;
};

class GuardedPort final : public port::RigPort {
 public:
  /// Keeps references to both.
  GuardedPort(port::RigPort& port, Lines& lines, const LinesConfig& config) noexcept;

  port::ReadResult Read(SensorFrame& frame, std::int64_t deadline_ns) noexcept override;
  bool Write(const CurrentFrame& frame) noexcept override;
  [[nodiscard]] port::PortCounters counters() const noexcept override { return port_.counters(); }
  [[nodiscard]] bool TakeTorsion(TorsionBatch& batch) noexcept override {
    return port_.TakeTorsion(batch);
  }
  /// Drops the enable line, whatever `last` says, and lets the port below say it.
  void SayGoodbye(const CurrentFrame& last) noexcept override;
  [[nodiscard]] std::string TakeNews() override { return port_.TakeNews(); }
  [[nodiscard]] std::string Trouble() const override { return port_.Trouble(); }
  [[nodiscard]] const LineCounters& line_counters() const noexcept { return counters_; }

 private:
  void TakeInputs(SensorFrame& frame) noexcept;
  void TakePulses(SensorFrame& frame) noexcept;

  port::RigPort& port_;
  Lines& lines_;
  std::optional<Heartbeat> heartbeat_;
  std::optional<KeyPhasor> key_phasor_;
  std::array<std::int64_t, 16> pulse_ns_{};
  bool chain_closed_{true};
  bool enabled_{false};
  bool write_failed_{false};
  LineCounters counters_;
};

}  // namespace levitas::gpio
