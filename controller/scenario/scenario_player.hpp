#pragma once
// Plays a scenario: gives the command of a step in one cycle, waits for what the step waits for,
// holds (with the step's excitation), goes on to the next step.
//
// Time     counted in cycles: call Next exactly once per cycle. The answer to a command is looked
//          for one cycle after it; a hold of n cycles excites exactly n cycles.
// Thread   one; Next allocates nothing, locks nothing, throws nothing. Text allocates.
// Failure  a refused command, a wait beyond its time-out or a trip ends the scenario: the command
//          is kNone from then on, `outcome` and Text say why. A trip that the scenario itself asked
//          for (do: emergency_stop, or until: tripped) is no failure until it has been reset.
// Not done what becomes of the rotor after the end: that is the caller's decision.

#include <cstdint>
#include <string>
#include <vector>

#include "common/axes.hpp"
#include "common/enums.hpp"
#include "controller/scenario/orbit_limiter.hpp"
#include "controller/scenario/scenario_config.hpp"
#include "controller/scenario/signal.hpp"

namespace levitas::scenario {

struct PlayerOutput {
  OperatorCommand command{OperatorCommand::kNone};
  double speed_rad_per_s{};          ///< with kSpin
  double acceleration_rad_per_s2{};  ///< with kSpin
  AxisArray excitation_a{};          ///< [A] per axis, to be added to the control current
  AxisArray excitation_m{};          ///< [m] per axis, to be added to the measured position
  double gain{1.0};  ///< of the step's limit of the orbit; below 1 it has reduced both
};

enum class Outcome : std::uint8_t { kPlaying, kFinished, kRefused, kTimedOut, kTripped };

/// "playing", "finished", "refused", "timed_out", "tripped".
[[nodiscard]] std::string_view Name(Outcome outcome) noexcept;

class ScenarioPlayer {
 public:
  /// Relative to the set point: a drive holds its speed far better than this.
  static constexpr double kSpeedTolerance = 0.005;

  /// `standstill_rad_per_s`: the controller's, below it the rotor counts as standing. Throws
  /// std::invalid_argument for a period that is not positive or an axis beyond kMaxAxes.
  ScenarioPlayer(ScenarioConfig config, double period_s, double standstill_rad_per_s);

  /// `mode`, `fault` and `refused` are the controller's outputs of the previous cycle; `radius_m`
  /// is the largest of any bearing in the newest frame; `standing`: it is proven that the rotor
  /// stands, which a wait for standstill or for the speed 0 needs as well.
  [[nodiscard]] PlayerOutput Next(Mode mode, double speed_rad_per_s, Fault fault,
                                  bool refused = false, double radius_m = 0.0,
                                  bool standing = true) noexcept;

  [[nodiscard]] Outcome outcome() const noexcept { return outcome_; }
  [[nodiscard]] bool finished() const noexcept { return outcome_ == Outcome::kFinished; }
  [[nodiscard]] bool failed() const noexcept { return outcome_ > Outcome::kFinished; }
  /// Index of the step being played; after a failure the one that failed.
  [[nodiscard]] std::size_t step() const noexcept { return step_; }
  /// One sentence for people; empty unless failed.
  [[nodiscard]] std::string Text() const;

 private:
  enum class Phase : std::uint8_t { kCommand, kWait, kHold };
  struct Source {
    Signal signal;
    std::size_t axis{};
    Injection point{};
    double amplitude{};  ///< [A] or [m]
  };
  struct Timing {
    std::uint64_t timeout_cycles{};
    std::uint64_t hold_cycles{};
  };

  [[nodiscard]] bool Reached(const Step& step, Mode mode, double speed_rad_per_s,
                             bool standing) const noexcept;
  [[nodiscard]] bool Ended(Fault fault, bool refused) noexcept;
  void Excite(PlayerOutput& output, double radius_m) noexcept;
  void Give(PlayerOutput& output) noexcept;
  [[nodiscard]] std::string Why() const;

  ScenarioConfig config_;
  double standstill_rad_per_s_;
  std::vector<Timing> timing_;                // one per step
  std::vector<std::vector<Source>> sources_;  // one list per step
  OrbitLimiter limiter_;
  std::size_t step_{0};
  Phase phase_{Phase::kCommand};
  std::uint64_t cycles_in_phase_{0};
  bool trip_expected_{false};
  Fault fault_{Fault::kNone};
  Mode last_mode_{Mode::kOff};
  double last_speed_rad_per_s_{0.0};
  Outcome outcome_{Outcome::kPlaying};
};

}  // namespace levitas::scenario
