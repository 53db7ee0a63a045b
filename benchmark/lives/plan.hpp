#pragma once
// What is drawn for one life: a profile of speed, what the operator does, and what goes wrong.
//
// Random   from the seed alone: the same seed is the same life, whatever else has been run.
// Kinds    one a life, in turn with the seed, so that every kind has its share; the last is two of
//          the others at once.
// Units    nanoseconds since the life began; speeds in rpm.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "benchmark/lives/mailbox.hpp"
#include "common/enums.hpp"
#include "common/frames.hpp"
#include "common/rig_numbers.hpp"
#include "controller/scenario/scenario_config.hpp"

namespace levitas::lives {

enum class Kind : std::uint8_t {
  kNone,
  kFramesLost,      ///< at random
  kCurrentsLost,    ///< at random
  kBurstsOfFrames,  ///< k of n
  kBurstsOfCurrents,
  kFramesLate,
  kCurrentsLate,
  kJitter,  ///< with reordering
  kTwice,   ///< duplicates
  kOlder,   ///< older frames among the new ones
  kSpeedGlitch,
  kSpeedNotFinite,
  kSpeedStuck,
  kPositionGlitch,
  kPositionNotFinite,
  kPositionStuck,
  kStall,  ///< the controller wakes up late
  kKill,
  kKillAndRestart,
  kRigRestart,
  kEmergencyStop,
  kRigStopBit,  ///< the rig's status bit, for some frames
  kCommands,    ///< an operator who asks for everything at any time
  kTestSignals,
  kEnd,  ///< as SIGTERM does it
  kTwo,  ///< two of the others
};
inline constexpr std::size_t kKindCount = 26;
[[nodiscard]] std::string_view Name(Kind kind) noexcept;

enum class Deed : std::uint8_t {
  kCommand,
  kExcite,
  kEmergencyStop,
  kRequestEnd,
  kKill,
  kRevive,
  kStall,
  kRestartRig,
};

/// Done once, at an instant.
struct Action {
  std::int64_t at_ns{};
  Deed deed{};
  OperatorCommand command{};
  double speed_rpm{};
  double rpm_per_s{};
  std::int64_t duration_ns{};  ///< of a stall, of a rig that is off
  std::size_t signal{};        ///< of LifePlan::signals
};

enum class Falsified : std::uint8_t { kSpeed, kSpeedHeld, kPosition, kPositionHeld, kStatus };

/// What the rig says wrongly between two instants.
struct Falsehood {
  std::int64_t from_ns{};
  std::int64_t to_ns{};
  Falsified what{};
  std::size_t axis{};
  double value{};  ///< [rad/s] or [m]; may be no number
  std::uint32_t status{};
};

struct LifePlan {
  std::uint64_t seed{};
  std::vector<Kind> kinds;
  std::int64_t length_ns{};
  std::uint32_t watchdog_periods{};
  bool keeps_order{};
  bool guards_signals{true};  ///< false: test signals without their guard, to show the harm
  bool plays_scenario{};  ///< the profile is a scenario: its end, or a trip, ends the controller
  scenario::ScenarioConfig scenario;
  std::vector<Action> actions;  ///< by time
  std::vector<LineTrouble> frame_troubles;
  std::vector<LineTrouble> current_troubles;
  std::vector<Falsehood> falsehoods;
  std::vector<scenario::Step> signals;
  std::string story;  ///< for people

  [[nodiscard]] bool Has(Kind kind) const noexcept;
};

/// Self-test, lift and settling of the shipped controllers are over.
inline constexpr double kLiftedS = 1.4;
/// Lift and levitate, the first step of every life that is a scenario.
[[nodiscard]] scenario::Step LiftStep();

[[nodiscard]] LifePlan DrawLife(std::uint64_t seed, double seconds, const RigNumbers& rig);

}  // namespace levitas::lives
