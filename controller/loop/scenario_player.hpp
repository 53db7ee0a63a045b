#pragma once
// Plays a scenario: gives each step's command in one cycle, waits for what the step waits for,
// holds, goes on. All times are counted in cycles.
//
// Thread   loop thread. `outcome` may be read by others after the loop has ended.
// Failure  a refused command, a wait beyond its time-out or a trip ends the scenario; what happens
//          to the rotor then is the caller's decision (operator_desk.hpp).

#include <cstdint>
#include <string>

#include "controller/loop/operator_source.hpp"
#include "controller/scenario/scenario_config.hpp"

namespace levitas::loop {

class ScenarioPlayer {
 public:
  enum class Outcome : std::uint8_t { kPlaying, kFinished, kRefused, kTimedOut, kTripped };

  /// `standstill_rad_per_s`: below it the rotor counts as standing.
  ScenarioPlayer(scenario::ScenarioConfig config, double period_s, double standstill_rad_per_s);

  [[nodiscard]] cycle::OperatorInput Next(const OperatorView& view) noexcept;
  [[nodiscard]] Outcome outcome() const noexcept { return outcome_; }
  /// One sentence for people, with the step's number; empty while nothing went wrong.
  [[nodiscard]] std::string Text() const;

 private:
  enum class Phase : std::uint8_t { kCommand, kWait, kHold };

  [[nodiscard]] bool Reached(const scenario::Step& step, const OperatorView& view) const noexcept;
  [[nodiscard]] std::uint64_t Cycles(double seconds) const noexcept;
  void Advance(const scenario::Step& step, const OperatorView& view) noexcept;

  scenario::ScenarioConfig config_;
  double period_s_;
  double standstill_rad_per_s_;
  std::size_t step_{0};
  Phase phase_{Phase::kCommand};
  std::uint64_t phase_start_{0};
  Outcome outcome_{Outcome::kPlaying};
};

}  // namespace levitas::loop
