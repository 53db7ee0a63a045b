#pragma once
// Who operates the rig in a cycle: a scenario, a person over the network, the end of the program.
//
// Thread       loop thread; no allocation, no lock, no exception in Next.
// Determinism  a source that looks at nothing but the view gives the same input for the same cycle.

#include <cstdint>

#include "controller/cycle/cycle_io.hpp"

namespace levitas::loop {

/// What an operator sees: the frame of this cycle and what the previous cycle made of its own.
struct OperatorView {
  std::uint64_t cycle{};
  Mode mode{Mode::kOff};
  Fault fault{Fault::kNone};
  bool amplifiers_enabled{};
  bool command_refused{};    ///< the previous cycle's command was not allowed
  bool standing{};           ///< the supervisor knows that the rotor stands (its latest decision)
  double speed_rad_per_s{};  ///< as the newest frame says
  double radius_m{};         ///< largest of any bearing in the newest frame
  AxisArray position_m{};    ///< as the newest frame says
};

class OperatorSource {
 public:
  virtual ~OperatorSource() = default;
  /// Asked once per cycle, in order.
  [[nodiscard]] virtual cycle::OperatorInput Next(const OperatorView& view) noexcept = 0;
  /// True when nothing more is wanted and the rig is at rest: the loop ends before its next cycle.
  [[nodiscard]] virtual bool Done() const noexcept = 0;
  /// CLOCK_MONOTONIC [ns] at which the emergency stop that the latest Next gave had been received;
  /// 0 when it gave none, or nobody knows. For the loop's statistics, not for its decisions.
  [[nodiscard]] virtual std::int64_t stop_received_ns() const noexcept { return 0; }
};

}  // namespace levitas::loop
