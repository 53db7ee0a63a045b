#pragma once
// The end of a run: brings the rotor down by commands, and says when nothing is left to wait for.
//
// Table      end_table.hpp: states, events and edges. This class finds the events and does what the
//            edges say.
// Requests   one that was not followed is made again after kRepeatSeconds: the mode table may have
//            refused it.
// Failure    a landing that is overdue becomes an emergency stop, and is news. Whatever turns
//            levitated after that is held. Where the brake does nothing the end is not waited for,
//            which is news too.
// Thread     loop thread; news and standing: any. No allocation, lock or exception.
// Not done   emergency stops of operators, which pass before any of this.

#include <atomic>
#include <cstdint>

#include "controller/loop/end_table.hpp"
#include "controller/loop/operator_source.hpp"
#include "controller/loop/run_down.hpp"

namespace levitas::loop {

/// What became of an end that did not go as planned.
struct EndNews {
  bool overdue{};            ///< the landing's limit has passed: it became an emergency stop
  bool brake_fails{};        ///< released, the speed does not fall: the end was not waited for
  double speed_rad_per_s{};  ///< magnitude when that was found
};

class EndOfRun {
 public:
  static constexpr double kRepeatSeconds = 0.1;

  /// `trip_window_s`: a trip's recording needs this much after the release.
  EndOfRun(const RunDownLimits& limits, double trip_window_s) noexcept;

  /// Once per cycle, before anything else.
  void Look(const OperatorView& view) noexcept;
  /// One of the first three events, from the caller, who knows of it.
  void Begin(EndEvent why, const OperatorView& view) noexcept;
  /// The command of this cycle. Once per cycle that has no other command, unless the state serves.
  [[nodiscard]] cycle::OperatorInput Next(const OperatorView& view) noexcept;

  [[nodiscard]] EndState state() const noexcept { return state_; }
  [[nodiscard]] bool serves() const noexcept { return Row(state_).serves; }
  [[nodiscard]] bool standing() const noexcept { return stands_.load(std::memory_order_relaxed); }
  [[nodiscard]] EndNews news() const noexcept;

 private:
  void Take(EndEvent event, const OperatorView& view, cycle::OperatorInput& input) noexcept;
  void Act(EndAction action, std::uint64_t cycle, cycle::OperatorInput& input) noexcept;
  [[nodiscard]] EndGuards Guards(const OperatorView& view) const noexcept;
  [[nodiscard]] EndEvent OfHeldRotor(const OperatorView& view) const noexcept;
  void Watch(const OperatorView& view) noexcept;
  void Tell(std::atomic<bool>& news) noexcept;

  RunDown run_down_;
  double acceleration_rad_per_s2_;
  std::uint64_t repeat_cycles_;
  std::uint64_t trip_window_cycles_;
  EndState state_{EndState::kServing};
  std::uint64_t requested_{0};  ///< cycle of the latest request
  std::uint64_t released_{0};   ///< cycle in which the magnets were found to have let go
  std::atomic<bool> stands_{false};
  std::atomic<bool> overdue_{false};
  std::atomic<bool> brake_fails_{false};
  std::atomic<double> news_speed_rad_per_s_{0.0};
};

}  // namespace levitas::loop
