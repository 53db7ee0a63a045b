#pragma once
// One drawn life, run and judged.
//
// Judged   by the plant itself, never by what a sensor or the controller says of it. A rotor is
//          turning above twice the controller's standstill.
// Harm     touched_under_current   contact in a touchdown bearing, turning, with the amplifiers on;
//                                  not the last 25 ms before a documented release, which is the
//                                  time that its protection takes to see what is wrong
//          released_at_speed       amplifiers off, turning, other than by a documented release
//          landed_at_speed         the reference was lowered, turning
//          left_turning            the controller ended by itself while the rotor turned
//          not_braked              amplifiers off, turning, a controller there, and the drive free
//                                  for more than 0.2 s
// Documented releases, docs/safety.md: the faults of group B and a levitated stop that is given up,
// where something that was drawn gives cause for them at that time; the rig's own watchdog where
// no new current came for as long as it waits.
// Documented contacts are counted apart: within 0.1 s of a controller that stood still for 1 ms or
// more, or of positions that were wrong and looked right; in a levitated stop while its line fails
// on. More than 25 ms of them, time without counted back, are a harm all the same.
// Thread   one per life; lives may run at once. Allocates.

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "benchmark/lives/plan.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "controller/scenario/excitation_guard.hpp"

namespace levitas::plant {
class PlantModel;
}  // namespace levitas::plant

namespace levitas::lives {

/// What all lives of a campaign have in common.
struct LifeRig {
  cycle::CycleConfig config;
  std::shared_ptr<const plant::PlantModel> model;
};
/// Paths or shipped names; without a controller the one that amb run takes. Throws BadInput.
[[nodiscard]] LifeRig LoadLifeRig(const std::string& rig, const std::string& controller);

enum class Harm : std::uint8_t {
  kTouchedUnderCurrent,
  kReleasedAtSpeed,
  kLandedAtSpeed,
  kLeftTurning,
  kNotBraked,
};
inline constexpr std::size_t kHarmCount = 5;
[[nodiscard]] std::string_view Name(Harm harm) noexcept;

struct HarmFound {
  Harm harm{};
  double at_s{};
  double speed_rpm{};
  std::string how;  ///< one sentence
};

struct LifeResult {
  std::uint64_t seed{};
  std::vector<Kind> kinds;
  std::string story;
  std::vector<HarmFound> harms;         ///< the first of each
  std::uint64_t periods_touched{};      ///< under current, turning, not forgiven
  std::uint64_t documented_contacts{};  ///< periods under current, turning
  std::uint64_t releases{};             ///< documented, turning
  double released_rpm{};                ///< fastest of them
  Fault fault{Fault::kNone};            ///< first that was latched
  double highest_rpm{};
  std::uint64_t excited_contacts{};  ///< periods in contact under current within 0.1 s of a signal
  double most_excitation_a{};        ///< injected into an axis
  double most_excitation_m{};
  scenario::GuardCounts reduced;  ///< of the test signals
};

[[nodiscard]] LifeResult RunLife(const LifeRig& rig, const LifePlan& plan);

}  // namespace levitas::lives
